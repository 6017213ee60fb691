#include "bbmc/system/data_log.h"

namespace towbench::bbmc {

bool DataLog::any_enabled() const noexcept {
  return enabled_[core::Axis::kY] || enabled_[core::Axis::kX];
}

bool DataLog::append(const DataLogRow& row) noexcept {
  if (full()) {
    ++refused_;
    return false;
  }
  storage_[size_++] = row;
  return true;
}

}  // namespace towbench::bbmc
