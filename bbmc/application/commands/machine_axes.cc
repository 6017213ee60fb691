#include "bbmc/application/commands/machine_axes.h"

namespace towbench::bbmc {

using core::Axis;
using core::ErrorCode;

bool applies(const OptionSpec& option, const Configuration& configuration) noexcept {
  const bool of_y = option.is_positional() && option.counts_of == CountsOf::kY;
  const bool of_x = option.is_positional() && option.counts_of == CountsOf::kX;
  return (!of_y || configuration.axes[Axis::kY].exists) &&
         (!of_x || configuration.axes[Axis::kX].exists);
}

ErrorCode must_exist(const Configuration& configuration, Axis axis, TextWriter& why) noexcept {
  if (configuration.axes[axis].exists) {
    return ErrorCode::kNone;
  }
  why.text("this machine has no axis ").text(core::name_of(axis));
  return ErrorCode::kRequestOutOfRange;
}

ErrorCode must_have_both(const Configuration& configuration, TextWriter& why) noexcept {
  const ErrorCode without_y = must_exist(configuration, Axis::kY, why);
  return without_y == ErrorCode::kNone ? must_exist(configuration, Axis::kX, why) : without_y;
}

}  // namespace towbench::bbmc
