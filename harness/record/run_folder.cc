#include "harness/record/run_folder.h"

#include <chrono>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "harness/record/line_writer.h"

namespace towbench::harness {
namespace {

// The longest directory that holds all the files.
std::filesystem::path common_directory(const SourceFiles& sources) {
  auto common = sources.front().path.parent_path();
  for (const auto& source : sources) {
    std::filesystem::path shared;
    auto a = common.begin();
    for (auto b = source.path.begin(); a != common.end() && b != source.path.end() && *a == *b;
         ++a, ++b) {
      shared /= *a;
    }
    common = shared;
  }
  return common;
}

std::tm utc() {
  return fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now()));
}

}  // namespace

std::filesystem::path create_run_folder(const std::filesystem::path& parent,
                                        const std::string& name, const std::string& short_hash) {
  std::filesystem::create_directories(parent);
  const std::string stem = fmt::format("{}-{}-{}", utc_now_compact(), name, short_hash);
  // Several runs in one second get -2, -3 ...; create_directory() succeeds for one
  // process alone.
  for (int copy = 1;; ++copy) {
    auto folder = parent / (copy == 1 ? stem : fmt::format("{}-{}", stem, copy));
    if (std::filesystem::create_directory(folder)) {
      return folder;
    }
  }
}

std::filesystem::path copy_inputs(const SourceFiles& sources, const std::filesystem::path& folder) {
  const auto common = common_directory(sources);
  const auto copy_of = [&](const SourceFile& source) {
    return std::filesystem::path("inputs") / source.path.lexically_relative(common);
  };
  for (const auto& source : sources) {
    const auto target = folder / copy_of(source);
    std::filesystem::create_directories(target.parent_path());
    write_atomically(target, source.text);
  }
  return copy_of(sources.front());
}

std::string utc_now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", utc());
}
std::string utc_now_compact() {
  return fmt::format("{:%Y%m%dT%H%M%SZ}", utc());
}

}  // namespace towbench::harness
