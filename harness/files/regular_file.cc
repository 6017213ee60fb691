#include "harness/files/regular_file.h"

#include <cerrno>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace towbench::harness {
namespace {

class Descriptor {
 public:
  // Does not wait for whoever may write to a pipe.
  explicit Descriptor(const std::filesystem::path& path) noexcept
      : number_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) {
      ::close(number_);
    }
  }
  [[nodiscard]] int number() const noexcept { return number_; }

 private:
  int number_;
};

}  // namespace

std::variant<std::string, Unreadable> read_regular_file(const std::filesystem::path& path,
                                                        std::uint64_t largest_bytes) {
  const Descriptor file(path);
  if (file.number() < 0) {
    return Unreadable{errno == ENOENT || errno == ENOTDIR ? "a path with no file"
                                                          : "a file that cannot be read"};
  }
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) {
    return Unreadable{"a file that cannot be read"};
  }
  if (S_ISDIR(status.st_mode)) {
    return Unreadable{"a directory"};
  }
  if (!S_ISREG(status.st_mode)) {
    return Unreadable{"a pipe or a device"};
  }
  if (static_cast<std::uint64_t>(status.st_size) > largest_bytes) {
    return Unreadable{"a file of " + std::to_string(status.st_size) + " bytes"};
  }
  std::string text;
  constexpr std::size_t kBlock = 1U << 20U;
  for (std::size_t size = 0;;) {
    text.resize(size + kBlock);
    const ssize_t count = ::read(file.number(), text.data() + size, kBlock);
    if (count < 0 && errno == EINTR) {
      continue;
    }
    if (count < 0) {
      return Unreadable{"a file that cannot be read"};
    }
    size += static_cast<std::size_t>(count);
    if (count == 0 || size > largest_bytes) {
      text.resize(size);
      break;
    }
  }
  if (text.size() > largest_bytes) {
    return Unreadable{"a file that grows"};
  }
  return text;
}

}  // namespace towbench::harness
