#include "bbmc/host/linux/pwm_channel.h"

#include <ctime>
#include <tuple>

#include <unistd.h>

namespace towbench::bbmc {
namespace {

using Access = SysfsFile::Access;

// After an export the device manager (udev) may still be handing over the files' rights.
constexpr int kTriesAfterExport = 50;
constexpr timespec kBetweenTries{.tv_sec = 0, .tv_nsec = 10'000'000};

}  // namespace

core::Status PwmChannel::export_channel(const LinuxPwmChannel& place, const std::string& chip,
                                        DeviceTrouble& trouble) {
  if (const auto opened = export_.open(chip + "/export", Access::kWrite, trouble); !opened) {
    return opened;
  }
  return export_.write_number(place.channel);
}

core::Status PwmChannel::open(const LinuxPwmChannel& place, const std::string& root,
                              DeviceTrouble& trouble) {
  const std::string chip = root + place.chip;
  const std::string folder = chip + "/pwm" + std::to_string(place.channel) + '/';
  const std::string last = folder + "enable";
  if (::access(folder.c_str(), F_OK) != 0) {
    if (const auto done = export_channel(place, chip, trouble); !done) {
      return done;
    }
    for (int i = 0; i < kTriesAfterExport && ::access(last.c_str(), W_OK) != 0; ++i) {
      ::nanosleep(&kBetweenTries, nullptr);
    }
  }
  for (const auto& [file, name] : {std::tuple{&enable_, "enable"},
                                   {&duty_, "duty_cycle"},
                                   {&period_, "period"},
                                   {&polarity_, "polarity"}}) {
    const Access access = file == &polarity_ ? Access::kWrite : Access::kReadWrite;
    if (const auto opened = file->open(folder + name, access, trouble); !opened) {
      return opened;
    }
  }
  // Somebody may have left it running.
  if (const auto done = set_enabled(false); !done) {
    return done;
  }
  return set_duty(0);
}

core::Status PwmChannel::start(std::uint64_t period_ns) noexcept {
  // Polarity changes only while disabled, and no duty may be longer than the period.
  if (const auto done = set_enabled(false); !done) {
    return done;
  }
  if (const auto done = set_duty(0); !done) {
    return done;
  }
  if (const auto done = period_.settle_number(period_ns); !done) {
    return done;
  }
  return polarity_.write_text("normal");
}

core::Status PwmChannel::set_duty(std::uint64_t duty_ns) noexcept {
  if (duty_ns == duty_written_ns_) {
    return {};
  }
  duty_written_ns_ = kUnknown;
  auto written = duty_.write_number(duty_ns);
  if (written) {
    duty_written_ns_ = duty_ns;
  }
  return written;
}

core::Status PwmChannel::set_enabled(bool enabled) noexcept {
  const std::uint64_t wanted = enabled ? 1 : 0;
  if (wanted == enable_written_) {
    return {};
  }
  enable_written_ = kUnknown;
  // Seldom done, and what must not be believed unseen: read back.
  auto written = enable_.settle_number(wanted);
  if (written) {
    enable_written_ = wanted;
  }
  return written;
}

void PwmChannel::make_safe() noexcept {
  duty_written_ns_ = kUnknown;
  enable_written_ = kUnknown;
  if (duty_.is_open()) {
    static_cast<void>(duty_.write_number(0));
  }
  if (enable_.is_open()) {
    static_cast<void>(enable_.write_number(0));
  }
}

}  // namespace towbench::bbmc
