#include "harness/panel/autogroup.h"

#include <cerrno>
#include <chrono>
#include <fstream>
#include <string>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "harness/panel/turns.h"

namespace towbench::harness {
namespace {

// The file reads "/autogroup-17 nice 0".
std::optional<int> nice_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string group;
  std::string word;
  int nice = 0;
  if (stream >> group >> word >> nice && word == "nice") {
    return nice;
  }
  return std::nullopt;
}

// 0, or why not.
int set_nice(const std::filesystem::path& file, int nice) {
  const auto text = std::to_string(nice);
  const int stream = ::open(file.c_str(), O_WRONLY | O_CLOEXEC | O_TRUNC);
  if (stream < 0) {
    return errno;
  }
  const int trouble = ::write(stream, text.data(), text.size()) < 0 ? errno : 0;
  (void)::close(stream);
  return trouble;
}

// Of anyone but root the kernel takes one change in a tenth of a second, whoever makes it.
bool set_nice_in_time(const std::filesystem::path& file, int nice) {
  constexpr int kTries = 5;
  for (int i = 0; i < kTries; ++i) {
    if (const int trouble = set_nice(file, nice); trouble != EAGAIN) {
      return trouble == 0;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(110));
  }
  return false;
}

}  // namespace

AheadOfOtherSessions::AheadOfOtherSessions(std::filesystem::path file) : file_(std::move(file)) {
  const auto now = nice_of(file_);
  if (now && *now > kAhead && set_nice_in_time(file_, kAhead)) {
    before_ = now;
  }
}

AheadOfOtherSessions::~AheadOfOtherSessions() {
  if (before_) {
    (void)set_nice_in_time(file_, *before_);
  }
}

}  // namespace towbench::harness
