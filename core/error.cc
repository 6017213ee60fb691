#include "core/error.h"

namespace towbench::core {
namespace {

constexpr std::string_view kUnknown = "unknown error number";

}  // namespace

std::string_view describe(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::kNone:
      return "no error";
    case ErrorCode::kDeviceUnknown:
      return "no such device";
    case ErrorCode::kDeviceNotOpen:
      return "device is not open";
    case ErrorCode::kDeviceAlreadyOpen:
      return "device is already open";
    case ErrorCode::kDeviceNotInitialised:
      return "device is not initialised";
    case ErrorCode::kDeviceBusy:
      return "device is busy";
    case ErrorCode::kDeviceBadArgument:
      return "device refuses the argument";
    case ErrorCode::kDeviceBadUnit:
      return "device has no such unit";
    case ErrorCode::kDeviceNoData:
      return "device has no data";
    case ErrorCode::kDeviceFull:
      return "device buffer is full";
    case ErrorCode::kDeviceUnsupported:
      return "device does not support the call";
    case ErrorCode::kRequestUnknown:
      return "unknown command";
    case ErrorCode::kRequestBadArgument:
      return "bad argument";
    case ErrorCode::kRequestOutOfRange:
      return "argument out of range";
    case ErrorCode::kRequestWrongState:
      return "not possible in this state";
    case ErrorCode::kRequestFaultLatched:
      return "a fault is latched; reset first";
    case ErrorCode::kRequestNotCalibrated:
      return "position is not calibrated";
    case ErrorCode::kRequestBeyondSoftLimit:
      return "motion would pass a soft limit";
    case ErrorCode::kRequestTooFast:
      return "speed is above what can be stopped";
    case ErrorCode::kRequestSwitchPressed:
      return "release the switch first";
    case ErrorCode::kRequestMissingArgument:
      return "missing argument";
    case ErrorCode::kRequestLogFull:
      return "data log is full";
    case ErrorCode::kMotionNotSettled:
      return "motion did not settle on its target in time";
    case ErrorCode::kFaultKillSwitch:
      return "kill switch";
    case ErrorCode::kFaultEndStopMin:
      return "end-stop min";
    case ErrorCode::kFaultEndStopMax:
      return "end-stop max";
    case ErrorCode::kFaultSoftLimit:
      return "soft limit passed";
    case ErrorCode::kFaultEncoderFrozen:
      return "encoder frozen";
    case ErrorCode::kFaultEncoderIllegalTransitions:
      return "encoder: illegal transitions";
    case ErrorCode::kFaultEncoderJump:
      return "encoder: count jumped";
    case ErrorCode::kFaultEncoderReversed:
      return "encoder: counts against the drive";
    case ErrorCode::kFaultEncoderIndex:
      return "encoder: index missing or displaced";
    case ErrorCode::kFaultEncoderNoise:
      return "encoder: noise";
    case ErrorCode::kFaultLinkLost:
      return "link to the plant lost";
    case ErrorCode::kFaultLinkCorrupt:
      return "link to the plant corrupt";
    case ErrorCode::kFaultAmplifierNotReady:
      return "amplifier not ready";
    case ErrorCode::kFaultControlOverrun:
      return "control tick overran";
    case ErrorCode::kFaultTrackingError:
      return "tracking error too large";
    case ErrorCode::kFaultStopTimeout:
      return "standstill not reached in time";
    case ErrorCode::kProtocolVersion:
      return "protocol versions differ";
    case ErrorCode::kProtocolFixtureMismatch:
      return "fixtures differ";
    case ErrorCode::kProtocolRole:
      return "both sides have the same role";
    case ErrorCode::kProtocolAxes:
      return "axes differ";
    case ErrorCode::kProtocolTick:
      return "ticks differ";
    case ErrorCode::kProtocolCapabilities:
      return "no common way to send encoder data";
    case ErrorCode::kProtocolNoHello:
      return "message before an accepted Hello";
    case ErrorCode::kFrameTooLong:
      return "frame too long";
    case ErrorCode::kFrameBadCrc:
      return "frame checksum wrong";
    case ErrorCode::kFrameTruncated:
      return "frame truncated";
    case ErrorCode::kMessageUnknown:
      return "unknown message";
    case ErrorCode::kMessageBadField:
      return "message field out of range";
    case ErrorCode::kPeerClosed:
      return "peer closed the link";
    case ErrorCode::kPeerSilent:
      return "peer is silent";
    case ErrorCode::kTransportFailed:
      return "transport failed";
    case ErrorCode::kSequence:
      return "message repeated, lost or out of order";
    case ErrorCode::kCarrierOverloaded:
      return "carrier is too slow for the worst case";
    case ErrorCode::kBothChannelsActive:
      return "both PWM channels active";
    case ErrorCode::kHardEndContact:
      return "contact with a hard end";
    case ErrorCode::kEncoderRateExceeded:
      return "encoder faster than its channels carry";
    case ErrorCode::kSupplyOverCurrent:
      return "supply over-current cut-out";
    case ErrorCode::kSupplyUnderVoltage:
      return "amplifier under-voltage cut-out";
    case ErrorCode::kTimeNotMonotonic:
      return "time ran backwards";
    case ErrorCode::kForeignPlantFailed:
      return "plant library failed";
  }
  return kUnknown;
}

bool is_known(ErrorCode code) noexcept {
  return describe(code).data() != kUnknown.data();
}

}  // namespace towbench::core
