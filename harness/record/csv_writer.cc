#include "harness/record/csv_writer.h"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace towbench::harness {

char* write_seconds(char* into, core::Nanoseconds time_ns) noexcept {
  if (time_ns < 0) {
    *into++ = '-';
    time_ns = -time_ns;
  }
  into = std::to_chars(into, into + kLongestSeconds, time_ns / core::kNanosecondsPerSecond).ptr;
  auto fraction_ns = time_ns % core::kNanosecondsPerSecond;
  if (fraction_ns == 0) {
    return into;
  }
  *into++ = '.';
  for (auto digit_ns = core::kNanosecondsPerSecond / 10; fraction_ns != 0; digit_ns /= 10) {
    *into++ = static_cast<char>('0' + fraction_ns / digit_ns);
    fraction_ns %= digit_ns;
  }
  return into;
}

CsvWriter::CsvWriter(const std::filesystem::path& path, std::string_view header)
    : buffer_(kBuffer_bytes + kLongestRow_bytes), cursor_(buffer_.data()) {
  constexpr mode_t kReadableByAll = 0644;
  file_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kReadableByAll);
  if (file_ < 0) {
    throw std::filesystem::filesystem_error("cannot create", path,
                                            std::error_code(errno, std::generic_category()));
  }
  cursor_ += header.copy(cursor_, kLongestRow_bytes);
  *cursor_++ = '\n';
  flush();
}

CsvWriter::~CsvWriter() {
  flush();
  ::close(file_);
}

CsvWriter& CsvWriter::time(core::Nanoseconds time_ns) noexcept {
  separate();
  cursor_ = write_seconds(cursor_, time_ns);
  return *this;
}

void CsvWriter::end_row() noexcept {
  *cursor_++ = '\n';
  row_is_empty_ = true;
  ++rows_;
  if (static_cast<std::size_t>(cursor_ - buffer_.data()) >= kBuffer_bytes) {
    flush();
  }
}

void CsvWriter::flush() noexcept {
  const char* next = buffer_.data();
  while (next < cursor_ && good_) {
    const auto written = ::write(file_, next, static_cast<std::size_t>(cursor_ - next));
    if (written < 0 && errno == EINTR) {
      continue;
    }
    good_ = written >= 0;
    next += written > 0 ? written : 0;
  }
  cursor_ = buffer_.data();
}

}  // namespace towbench::harness
