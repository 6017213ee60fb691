#include "tests/bbmc/support/fake_board.h"

#include <array>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "core/check.h"

namespace towbench::tests {
namespace {

namespace fs = std::filesystem;
using bbmc::Line;
using core::Axis;

std::string counter_of(Axis axis) {
  return "/sys/bus/counter/devices/counter" + std::to_string(core::index_of(axis));
}
std::string chip_of(Axis axis) {
  return "/sys/class/pwm/pwmchip" + std::to_string(2 * core::index_of(axis));
}

}  // namespace

FakeBoard::FakeBoard() {
  // In memory where the system has a place for that.
  const fs::path place = fs::exists("/dev/shm") ? "/dev/shm" : fs::temp_directory_path();
  std::string folder = (place / "towbench-board-XXXXXX").string();
  core::check(::mkdtemp(folder.data()) != nullptr);
  root_ = folder;
  devices_.root = folder;
  for (Axis axis : core::kPlanarAxes) {
    for (const char* name : {"count", "ceiling", "enable", "function"}) {
      write(counter_of(axis) + "/count0/" + name, 0);
    }
    for (unsigned channel : {0U, 1U}) {
      for (const char* name : {"period", "duty_cycle", "polarity", "enable"}) {
        write(pwm_file(axis, channel, name), 0);
      }
    }
    write(chip_of(axis) + "/export", "");
    bbmc::LinuxAxis& wired = devices_.axes[axis];
    wired.encoder.counter = counter_of(axis);
    wired.pwm.towards_max = {.chip = chip_of(axis), .channel = 0};
    wired.pwm.towards_min = {.chip = chip_of(axis), .channel = 1};
    wired.hall_min = line_file(bbmc::hall_min_of(axis));
    wired.hall_max = line_file(bbmc::hall_max_of(axis));
    wired.amplifier_ready = line_file(bbmc::amplifier_ready_of(axis));
    wired.amplifier_enable = line_file(bbmc::amplifier_enable_of(axis));
  }
  devices_.kill_switch = line_file(Line::kKillSwitch);
  for (std::size_t i = 0; i < bbmc::kLineCount; ++i) {
    write(line_file(static_cast<Line>(i)), 0);
  }
}

FakeBoard::~FakeBoard() {
  for (const auto& [file, descriptor] : open_) {
    ::close(descriptor);
  }
  std::error_code ignored;
  fs::remove_all(root_, ignored);
}

std::string FakeBoard::count_file(Axis axis) {
  return counter_of(axis) + "/count0/count";
}

std::string FakeBoard::pwm_file(Axis axis, unsigned channel, const char* name) {
  return chip_of(axis) + "/pwm" + std::to_string(channel) + '/' + name;
}

std::string FakeBoard::line_file(Line line) {
  return "/sys/class/gpio/" + std::string(bbmc::name_of(line)) + "/value";
}

int FakeBoard::descriptor_of(const std::string& file) const {
  const auto [place, is_new] = open_.try_emplace(file, -1);
  if (is_new) {
    const std::string path = root_.string() + file;
    fs::create_directories(fs::path(path).parent_path());
    place->second = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    core::check(place->second >= 0);
  }
  return place->second;
}

void FakeBoard::replace(const std::string& file, const std::string& target) const {
  if (const auto found = open_.find(file); found != open_.end()) {
    ::close(found->second);
    open_.erase(found);
  }
  fs::remove(root_.string() + file);
  fs::create_symlink(target, root_.string() + file);
}

void FakeBoard::write(const std::string& file, const std::string& text) const {
  const int descriptor = descriptor_of(file);
  core::check(::ftruncate(descriptor, 0) == 0);
  core::check(::pwrite(descriptor, text.data(), text.size(), 0) ==
              static_cast<ssize_t>(text.size()));
}

void FakeBoard::write(const std::string& file, std::uint64_t number) const {
  // A shorter number than before leaves its rest on a second line, which nobody reads.
  const std::string text = std::to_string(number) + '\n';
  core::check(::pwrite(descriptor_of(file), text.data(), text.size(), 0) ==
              static_cast<ssize_t>(text.size()));
}

std::string FakeBoard::first_line(const std::string& file) const {
  std::array<char, 64> text{};
  core::check(::pread(descriptor_of(file), text.data(), text.size() - 1, 0) >= 0);
  const std::string all = text.data();
  return all.substr(0, all.find('\n'));
}

std::uint64_t FakeBoard::read(const std::string& file) const {
  return std::stoull(first_line(file));
}

bool FakeBoard::is_safe() const {
  bool safe = true;
  for (Axis axis : core::kPlanarAxes) {
    for (unsigned channel : {0U, 1U}) {
      safe = safe && read(pwm_file(axis, channel, "duty_cycle")) == 0 &&
             read(pwm_file(axis, channel, "enable")) == 0;
    }
    safe = safe && read(line_file(bbmc::amplifier_enable_of(axis))) == 0;
  }
  return safe;
}

void FakeBoard::refuse_every_write(const std::string& file) const {
  replace(file, "/dev/full");
}

void FakeBoard::refuse_the_value(const std::string& file) const {
  replace(file, "/proc/self/oom_score_adj");  // takes -1000 .. 1000
}

FakeBoard::Seal::~Seal() {
  ::close(descriptor_);
}

void FakeBoard::Seal::close_for_writing() const {
  core::check(::fcntl(descriptor_, F_ADD_SEALS, F_SEAL_WRITE) == 0);
}

FakeBoard::Seal FakeBoard::sealable(const std::string& file) const {
  const int descriptor = ::memfd_create("attribute", MFD_ALLOW_SEALING | MFD_CLOEXEC);
  core::check(descriptor >= 0 && ::pwrite(descriptor, "0\n", 2, 0) == 2);
  replace(file, "/proc/self/fd/" + std::to_string(descriptor));
  return Seal(descriptor);
}

}  // namespace towbench::tests
