#include "bbmc/host/linux/linux_line.h"

#include <string_view>
#include <utility>

#include "bbmc/host/linux/chip_line.h"
#include "bbmc/host/linux/file_line.h"

namespace towbench::bbmc {

core::Result<std::unique_ptr<LinuxLine>> LinuxLine::open(const std::string& place,
                                                         const std::string& root,
                                                         Direction direction,
                                                         DeviceTrouble& trouble) {
  std::string_view where = place;
  const bool active_low = where.starts_with('!');
  where.remove_prefix(active_low ? 1 : 0);
  if (where.starts_with('/')) {
    auto line = std::make_unique<FileLine>();
    const auto opened = line->open(root + std::string(where), direction, active_low, trouble);
    if (!opened) {
      return core::failure(opened.error());
    }
    return line;
  }
  auto line = std::make_unique<ChipLine>();
  const auto opened = line->open(std::string(where), direction, active_low, trouble);
  if (!opened) {
    return core::failure(opened.error());
  }
  return line;
}

}  // namespace towbench::bbmc
