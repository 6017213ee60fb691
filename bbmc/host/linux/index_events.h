// The index of an encoder from a counter's character device (linux/counter.h): the driver latches
// the count in its interrupt and queues it with the time; here the queue is read without waiting.
#pragma once

#include <cstdint>
#include <string>

#include "bbmc/host/linux/device_trouble.h"
#include "core/result.h"
#include "core/time.h"

namespace towbench::bbmc {

struct IndexEvent {
  core::Nanoseconds time_ns = 0;  // by the kernel's monotonic clock
  std::uint64_t count = 0;        // as the device counts, not unwrapped
};

class IndexEvents {
 public:
  IndexEvents() noexcept = default;
  IndexEvents(const IndexEvents&) = delete;
  IndexEvents& operator=(const IndexEvents&) = delete;
  ~IndexEvents();

  // Asks for the value of `count` at each index pulse. `trouble` outlives this.
  [[nodiscard]] core::Status open(const std::string& path, unsigned count, DeviceTrouble& trouble);
  // Takes over a descriptor that delivers counter_event records and does not block.
  void adopt(int descriptor, DeviceTrouble& trouble) noexcept;
  [[nodiscard]] bool is_open() const noexcept { return descriptor_ >= 0; }

  // The next event that waits; false when there is none. An event that the driver could not fill,
  // and half a record, are failures.
  [[nodiscard]] core::Result<bool> next(IndexEvent& event) noexcept;

 private:
  std::string path_;
  DeviceTrouble* trouble_ = nullptr;
  int descriptor_ = -1;
};

}  // namespace towbench::bbmc
