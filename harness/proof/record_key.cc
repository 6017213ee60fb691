#include "harness/proof/record_key.h"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <sys/random.h>
#include <unistd.h>

#include "harness/proof/sha256.h"

namespace towbench::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kKeyBytes = 32;

fs::path state_folder() {
  const auto absolute = [](const char* name) {
    const char* const value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nobody sets it
    fs::path path = value == nullptr ? "" : value;
    return path.is_absolute() ? path : fs::path();
  };
  if (auto state = absolute("XDG_STATE_HOME"); !state.empty()) {
    return state / "towbench";
  }
  const auto home = absolute("HOME");
  return home.empty() ? home : home / ".local" / "state" / "towbench";
}

std::optional<std::string> read_key(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    return std::nullopt;
  }
  std::ifstream stream(file, std::ios::binary);
  std::string key(std::istreambuf_iterator<char>(stream), {});
  return key.size() == kKeyBytes ? std::optional(std::move(key)) : std::nullopt;
}

// Whole under its final name, or not there: two programs that start together agree on one key.
void make_key(const fs::path& file) {
  std::array<char, kKeyBytes> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    return;
  }
  auto pattern = file.string() + ".XXXXXX";
  const int descriptor = mkostemp(pattern.data(), O_CLOEXEC);  // for its user only
  if (descriptor < 0) {
    return;
  }
  const bool written =
      write(descriptor, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
  if (close(descriptor) == 0 && written) {
    (void)link(pattern.c_str(), file.c_str());
  }
  (void)unlink(pattern.c_str());
}

}  // namespace

std::optional<std::string> record_key() {
  const auto folder = state_folder();
  if (folder.empty()) {
    return std::nullopt;
  }
  const auto file = folder / "record.key";
  if (auto key = read_key(file)) {
    return key;
  }
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) {
    make_key(file);
  }
  return read_key(file);
}

std::string name_of_key(const std::string& key) {
  constexpr std::size_t kNameDigits = 16;
  return sha256("towbench record key " + key).substr(0, kNameDigits);
}

}  // namespace towbench::harness
