#include "bbmc/application/reports/report.h"

namespace towbench::bbmc {

bool Report::next(SystemManager& system, TextWriter& out) noexcept {
  bool more = false;
  if (auto* const help = std::get_if<HelpReport>(&content_)) {
    more = help->next(system, out);
  } else if (auto* const status = std::get_if<StatusReport>(&content_)) {
    more = status->next(system, out);
  } else if (auto* const data = std::get_if<DataLogReport>(&content_)) {
    more = data->next(system, out);
  } else if (auto* const perf = std::get_if<PerfLogReport>(&content_)) {
    more = perf->next(system, out);
  } else if (auto* const config = std::get_if<ConfigReport>(&content_)) {
    more = config->next(system, out);
  }
  if (!more) {
    stop();
  }
  return more;
}

}  // namespace towbench::bbmc
