// What a machine with one axis takes of a command and what it refuses.
#pragma once

#include "bbmc/application/commands/option.h"
#include "bbmc/application/console/text_writer.h"
#include "bbmc/system/configuration.h"
#include "core/axis.h"
#include "core/error.h"

namespace towbench::bbmc {

// False for the place of an axis that the machine lacks: `goto Y X` is `goto Y` without X.
[[nodiscard]] bool applies(const OptionSpec& option, const Configuration& configuration) noexcept;

// kNone, or kRequestOutOfRange and in `why` which axis there is not.
[[nodiscard]] core::ErrorCode must_exist(const Configuration& configuration, core::Axis axis,
                                         TextWriter& why) noexcept;
[[nodiscard]] core::ErrorCode must_have_both(const Configuration& configuration,
                                             TextWriter& why) noexcept;

}  // namespace towbench::bbmc
