#include "harness/record/line_writer.h"

#include <cerrno>
#include <fstream>
#include <system_error>

namespace towbench::harness {
namespace {

[[noreturn]] void fail(const char* what, const std::filesystem::path& path) {
  throw std::filesystem::filesystem_error(what, path,
                                          std::error_code(errno, std::generic_category()));
}

}  // namespace

LineWriter::LineWriter(const std::filesystem::path& path) : file_(std::fopen(path.c_str(), "we")) {
  if (file_ == nullptr) {
    fail("cannot create", path);
  }
}

void LineWriter::write(std::string_view text) noexcept {
  good_ = good_ && std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size();
}

void LineWriter::flush() noexcept {
  good_ = std::fflush(file_.get()) == 0 && good_;
}

void write_atomically(const std::filesystem::path& path, std::string_view text) {
  auto temporary = path;
  temporary += ".part";
  {
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    stream << text;
    stream.flush();
    if (!stream) {
      fail("cannot write", temporary);
    }
  }
  std::filesystem::rename(temporary, path);
}

}  // namespace towbench::harness
