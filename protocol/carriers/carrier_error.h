// Why a carrier could not be set up: a numbered error and a sentence for the user that names the
// path, port or interface. Failures after set-up are plain core::ErrorCode (byte_stream.h).
#pragma once

#include <string>

#include <tl/expected.hpp>

#include "core/error.h"

namespace towbench::protocol {

struct CarrierError {
  core::ErrorCode code = core::ErrorCode::kTransportFailed;
  std::string message;
};

template <typename T>
using CarrierResult = tl::expected<T, CarrierError>;

[[nodiscard]] inline tl::unexpected<CarrierError> carrier_failure(core::ErrorCode code,
                                                                  std::string message) {
  return tl::unexpected<CarrierError>(CarrierError{code, std::move(message)});
}

}  // namespace towbench::protocol
