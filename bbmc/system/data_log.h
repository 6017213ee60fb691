// BBMC's own data log: one row a control tick while a motion runs, into storage of fixed size.
//
// When the storage is full recording stops, the machine does not (defect 10): full() says so, rows
// already there stay.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bbmc/device/axes.h"
#include "bbmc/system/telemetry_row.h"
#include "core/realtime.h"
#include "core/time.h"

namespace towbench::bbmc {

inline constexpr std::size_t kDataLogRows = 131'072;  // BBMC 0.5

struct DataLogAxis {
  std::int64_t count = 0;
  float speed_count_per_s = 0;
  float reference_speed_count_per_s = 0;
  double reference_count = 0;
  float duty_pct = 0;
  AxisMode mode = AxisMode::kIdle;
};

struct DataLogRow {
  core::Nanoseconds time_ns = 0;  // since the start of the motion
  PerAxis<DataLogAxis> axes;
};

class DataLog {
 public:
  // Storage outlives the log; its size is the capacity.
  explicit DataLog(std::span<DataLogRow> storage) noexcept : storage_(storage) {}

  void reset() noexcept {
    size_ = 0;
    refused_ = 0;
  }
  void enable(core::Axis axis, bool on) noexcept { enabled_[axis] = on; }
  [[nodiscard]] bool enabled(core::Axis axis) const noexcept { return enabled_[axis]; }
  [[nodiscard]] bool any_enabled() const noexcept;

  // False when full: the row is counted in refused() and dropped.
  TOWBENCH_REALTIME bool append(const DataLogRow& row) noexcept;

  [[nodiscard]] std::span<const DataLogRow> rows() const noexcept { return storage_.first(size_); }
  [[nodiscard]] std::size_t capacity() const noexcept { return storage_.size(); }
  [[nodiscard]] bool full() const noexcept { return size_ == storage_.size(); }
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }

 private:
  std::span<DataLogRow> storage_;
  std::size_t size_ = 0;
  std::uint64_t refused_ = 0;
  PerAxis<bool> enabled_{{true, true}};
};

}  // namespace towbench::bbmc
