#include "bbmc/host/linux/linux_counter.h"

namespace towbench::bbmc {
namespace {

using core::ErrorCode;
using core::failure;
using Access = SysfsFile::Access;

}  // namespace

core::Status LinuxCounter::open(const LinuxEncoderPlace& place, const std::string& root,
                                DeviceTrouble& trouble) {
  trouble_ = &trouble;
  ceiling_ = place.ceiling;
  inverted_ = place.inverted;
  const std::string folder = root + place.counter + "/count" + std::to_string(place.count) + '/';
  for (const auto& [file, name, access] : {std::tuple{&count_, "count", Access::kRead},
                                           {&ceiling_file_, "ceiling", Access::kReadWrite},
                                           {&enable_, "enable", Access::kReadWrite},
                                           {&function_, "function", Access::kWrite}}) {
    if (const auto opened = file->open(folder + name, access, trouble); !opened) {
      return opened;
    }
  }
  return place.index_events.empty() ? core::Status()
                                    : index_.open(root + place.index_events, place.count, trouble);
}

core::Status LinuxCounter::apply(const Eqep::Settings& settings) noexcept {
  if (is_open() && !set_up_) {
    if (const auto done = function_.write_text("quadrature x4"); !done) {
      return done;
    }
    if (const auto done = ceiling_file_.settle_number(ceiling_); !done) {
      return done;
    }
    if (const auto done = enable_.settle_number(1); !done) {
      return done;
    }
    set_up_ = true;
  }
  settings_ = settings;
  capture_.set_clock(settings.capture_clock_Hz);
  return {};
}

std::int64_t LinuxCounter::unwrapped(std::uint64_t raw) const noexcept {
  const auto range = static_cast<std::int64_t>(ceiling_) + 1;
  std::int64_t change = static_cast<std::int64_t>(raw) - static_cast<std::int64_t>(raw_);
  if (change > range / 2) {
    change -= range;
  } else if (change < -(range / 2)) {
    change += range;
  }
  return total_ + (inverted_ ? -change : change);
}

core::Status LinuxCounter::sample(core::Nanoseconds now_ns) noexcept {
  time_ns_ = now_ns;
  if (!is_open()) {
    return {};
  }
  const auto raw = count_.read_number();
  if (!raw) {
    return failure(raw.error());
  }
  if (*raw > ceiling_) {
    return trouble_->note_value(count_.path(), ErrorCode::kDeviceNoData, *raw, ceiling_);
  }
  if (!started_) {
    // Wherever the device stands, the count of this run begins at 0.
    started_ = true;
    raw_ = *raw;
  }
  if (index_.is_open()) {
    if (const auto done = take_index_pulses(); !done) {
      return done;
    }
  }
  total_ = unwrapped(*raw);
  raw_ = *raw;
  capture_.sample(now_ns, total_);
  return {};
}

core::Status LinuxCounter::take_index_pulses() noexcept {
  IndexEvent event;
  for (;;) {
    const auto more = index_.next(event);
    if (!more) {
      return failure(more.error());
    }
    if (!*more) {
      return {};
    }
    ++index_pulses_;
    index_total_ = unwrapped(event.count);
  }
}

core::Status LinuxCounter::read(Eqep::Reading& reading) noexcept {
  reading = {};
  capture_.tell(time_ns_, reading);
  reading.position = position_of(total_);
  reading.index_pulses = index_pulses_;
  reading.index_position = position_of(index_total_);
  return {};
}

core::Status LinuxCounter::write(const Eqep::Command& command) noexcept {
  offset_ = static_cast<std::int64_t>(command.position) - total_;
  return {};
}

std::uint32_t LinuxCounter::position_of(std::int64_t total) const noexcept {
  const std::int64_t range = static_cast<std::int64_t>(settings_.position_max) + 1;
  const std::int64_t rest = (total + offset_) % range;
  return static_cast<std::uint32_t>(rest < 0 ? rest + range : rest);
}

}  // namespace towbench::bbmc
