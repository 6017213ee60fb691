#include "study/procedures/recording_frames.h"

#include <algorithm>
#include <cstdlib>

namespace towbench::study::procedures {
namespace {

template <typename T>
void drop_front(std::vector<T>& column, std::size_t rows) {
  column.erase(column.begin(),
               column.begin() + static_cast<std::ptrdiff_t>(std::min(rows, column.size())));
}

}  // namespace

void drop_other_frames(identify::Recording& recording) {
  constexpr std::int64_t kJump = 2000;
  std::size_t from = 0;
  for (const auto& axis : recording.axes) {
    for (std::size_t k = 1; k < axis.count.size(); ++k) {
      if (std::abs(axis.count[k] - axis.count[k - 1]) > kJump && axis.duty_pct[k] == 0) {
        from = std::max(from, k);
      }
    }
  }
  for (const auto which : core::kPlanarAxes) {
    auto& axis = recording.axes[which];
    drop_front(axis.count, from);
    drop_front(axis.duty_pct, from);
    drop_front(axis.reference_m, from);
    drop_front(axis.reference_velocity_m_per_s, from);
    drop_front(axis.velocity_m_per_s, from);
    drop_front(axis.mode, from);
    drop_front(axis.current_A, from);
    drop_front(recording.force_N[which], from);
  }
  drop_front(recording.time_s, from);
}

}  // namespace towbench::study::procedures
