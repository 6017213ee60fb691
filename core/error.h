// Numbered errors. A number is grouped by its origin, printed to the user, and never reused: a row
// that is no longer raised stays here, marked retired.
//
// Three kinds of trouble, never mixed: a bug aborts (core/check.h); bad configuration is refused
// at start; a failure at run time is a returned Result or a latched fault.
#pragma once

#include <cstdint>
#include <string_view>

namespace towbench::core {

enum class ErrorCode : std::uint16_t {
  kNone = 0,

  // 1xx: BBMC device layer, calls that a driver or the device manager refuses.
  kDeviceUnknown = 100,
  kDeviceNotOpen = 101,
  kDeviceAlreadyOpen = 102,
  kDeviceNotInitialised = 103,
  kDeviceBusy = 104,
  kDeviceBadArgument = 105,
  kDeviceBadUnit = 106,
  kDeviceNoData = 107,
  kDeviceFull = 108,
  kDeviceUnsupported = 109,

  // 2xx: BBMC system and application layers, requests that are refused. Nothing has changed.
  kRequestUnknown = 200,
  kRequestBadArgument = 201,
  kRequestOutOfRange = 202,
  kRequestWrongState = 203,
  kRequestFaultLatched = 204,
  kRequestNotCalibrated = 205,
  kRequestBeyondSoftLimit = 206,
  kRequestTooFast = 207,
  kRequestSwitchPressed = 208,
  kRequestMissingArgument = 209,
  kRequestLogFull = 210,
  kMotionNotSettled = 211,  // a result, not a refusal: the target was not reached in time

  // 3xx: BBMC faults. Latched; the drive is removed until an explicit reset.
  kFaultKillSwitch = 300,
  kFaultEndStopMin = 301,
  kFaultEndStopMax = 302,
  kFaultSoftLimit = 303,
  kFaultEncoderFrozen = 310,
  kFaultEncoderIllegalTransitions = 311,
  kFaultEncoderJump = 312,
  kFaultEncoderReversed = 313,
  kFaultEncoderIndex = 314,
  kFaultEncoderNoise = 315,
  kFaultLinkLost = 320,
  kFaultLinkCorrupt = 321,
  kFaultAmplifierNotReady = 330,
  kFaultControlOverrun = 340,
  kFaultTrackingError = 350,
  kFaultStopTimeout = 351,

  // 4xx: protocol.
  kProtocolVersion = 400,
  kProtocolFixtureMismatch = 401,
  kProtocolRole = 402,
  kProtocolAxes = 403,
  kProtocolTick = 404,
  kProtocolCapabilities = 405,
  kProtocolNoHello = 406,
  kFrameTooLong = 410,
  kFrameBadCrc = 411,
  kFrameTruncated = 412,
  kMessageUnknown = 413,
  kMessageBadField = 414,
  kPeerClosed = 420,
  kPeerSilent = 421,
  kTransportFailed = 422,
  kSequence = 423,
  kCarrierOverloaded = 424,

  // 5xx: what the emulator reports of the machine or of how it is driven.
  kBothChannelsActive = 500,
  kHardEndContact = 501,
  kEncoderRateExceeded = 502,
  kSupplyOverCurrent = 503,
  kSupplyUnderVoltage = 504,
  kTimeNotMonotonic = 505,
  kForeignPlantFailed = 506,
};

[[nodiscard]] constexpr std::uint16_t number_of(ErrorCode code) noexcept {
  return static_cast<std::uint16_t>(code);
}

// A short English phrase, e.g. "device not open". Never empty.
[[nodiscard]] std::string_view describe(ErrorCode code) noexcept;

// False for a number that stands for no error above: it came off a wire.
[[nodiscard]] bool is_known(ErrorCode code) noexcept;

}  // namespace towbench::core
