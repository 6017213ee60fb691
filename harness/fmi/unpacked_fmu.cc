#include "harness/fmi/unpacked_fmu.h"

#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <variant>

#include <fmt/format.h>
#include <unistd.h>

#include "emulator/fmi/fmi3.h"
#include "harness/files/regular_file.h"
#include "harness/fmi/fmu_archive.h"

namespace towbench::harness {
namespace {

namespace fs = std::filesystem;

std::string platforms_in(const fs::path& binaries) {
  std::string names;
  if (fs::is_directory(binaries)) {
    for (const auto& entry : fs::directory_iterator(binaries)) {
      names += (names.empty() ? "" : ", ") + entry.path().filename().string();
    }
  }
  return names.empty() ? "none" : names;
}

}  // namespace

UnpackedFmu::UnpackedFmu() : owner_(getpid()) {
  auto pattern = (fs::temp_directory_path() / "towbench-fmu-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) {
    throw fs::filesystem_error("mkdtemp", pattern, std::error_code(errno, std::generic_category()));
  }
  folder_ = pattern;
}

UnpackedFmu::~UnpackedFmu() {
  if (getpid() == owner_) {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
}

std::shared_ptr<const UnpackedFmu> UnpackedFmu::open(const std::string& archive, std::string& why) {
  std::shared_ptr<UnpackedFmu> fmu(new UnpackedFmu);
  why = fmu->unpack(archive);
  return why.empty() ? fmu : nullptr;
}

std::string UnpackedFmu::unpack(const std::string& archive) {
  if (auto wrong = unpack_fmu(archive, folder_); !wrong.empty()) {
    return wrong;
  }
  const auto xml = read_regular_file(folder_ / "modelDescription.xml", 1U << 26U);
  if (const auto* unreadable = std::get_if<Unreadable>(&xml)) {
    return fmt::format("has no modelDescription.xml ({})", unreadable->what);
  }
  if (auto wrong = read_description(std::get<std::string>(xml), description_); !wrong.empty()) {
    return wrong;
  }
  if (!fs::is_regular_file(library())) {
    return fmt::format("has no binary for {}; for: {}", fmi3::kPlatform,
                       platforms_in(folder_ / "binaries"));
  }
  return {};
}

fs::path UnpackedFmu::library() const {
  return folder_ / "binaries" / fmi3::kPlatform / (description_.identifier + ".so");
}

std::string UnpackedFmu::resources() const {
  return (folder_ / "resources").string() + '/';
}

}  // namespace towbench::harness
