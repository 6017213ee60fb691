#include "bbmc/host/linux/index_events.h"

#include <cerrno>

#include <fcntl.h>
#include <linux/counter.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace towbench::bbmc {

IndexEvents::~IndexEvents() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

core::Status IndexEvents::open(const std::string& path, unsigned count, DeviceTrouble& trouble) {
  path_ = path;
  trouble_ = &trouble;
  descriptor_ = ::open(path_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) {
    return trouble.note(DeviceCall::kOpen, path_, errno);
  }
  counter_watch watch{};
  watch.component.type = COUNTER_COMPONENT_COUNT;
  watch.component.scope = COUNTER_SCOPE_COUNT;
  watch.component.parent = static_cast<__u8>(count);
  watch.event = COUNTER_EVENT_INDEX;
  watch.channel = static_cast<__u8>(count);
  if (::ioctl(descriptor_, COUNTER_ADD_WATCH_IOCTL, &watch) != 0 ||
      ::ioctl(descriptor_, COUNTER_ENABLE_EVENTS_IOCTL) != 0) {
    return trouble.note(DeviceCall::kControl, path_, errno);
  }
  return {};
}

void IndexEvents::adopt(int descriptor, DeviceTrouble& trouble) noexcept {
  trouble_ = &trouble;
  descriptor_ = descriptor;
}

core::Result<bool> IndexEvents::next(IndexEvent& event) noexcept {
  counter_event record{};
  const ssize_t size = ::read(descriptor_, &record, sizeof record);
  if (size < 0 && (errno == EAGAIN || errno == EINTR)) {
    return false;
  }
  if (size != static_cast<ssize_t>(sizeof record) || record.status != 0) {
    const int error = size < 0             ? errno
                      : size == 0          ? ENODEV
                      : record.status != 0 ? record.status
                                           : EIO;
    return core::failure(trouble_->note(DeviceCall::kRead, path_, error).error());
  }
  event = {.time_ns = static_cast<core::Nanoseconds>(record.timestamp), .count = record.value};
  return true;
}

}  // namespace towbench::bbmc
