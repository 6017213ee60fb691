#include "harness/campaign/results_file.h"

#include <cerrno>
#include <fstream>
#include <system_error>

namespace towbench::harness {
namespace {

[[noreturn]] void refuse_file(const std::filesystem::path& path) {
  throw std::system_error(errno, std::generic_category(), path.string() + " cannot be written");
}

bool ends_inside_a_line(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  if (!stream || stream.tellg() <= 0) {
    return false;
  }
  stream.seekg(-1, std::ios::end);
  return stream.get() != '\n';
}

}  // namespace

ResultsFile::ResultsFile(const std::filesystem::path& path)
    : path_(path), file_(std::fopen(path.c_str(), "ae")) {
  if (file_ == nullptr) {
    refuse_file(path);
  }
  if (ends_inside_a_line(path)) {
    append("");
  }
}

void ResultsFile::append(const std::string& line) {
  const auto whole = line + '\n';
  if (std::fwrite(whole.data(), 1, whole.size(), file_.get()) != whole.size() ||
      std::fflush(file_.get()) != 0) {
    refuse_file(path_);
  }
}

}  // namespace towbench::harness
