// The id of each message but EncoderEdges, whose payload the codec writes by hand.
#pragma once

#include <type_traits>

#include "protocol/codec.h"

namespace towbench::protocol {

template <typename Message>
struct IdOf;
template <>
struct IdOf<Hello> : std::integral_constant<MessageId, MessageId::kHello> {};
template <>
struct IdOf<HelloReply> : std::integral_constant<MessageId, MessageId::kHelloReply> {};
template <>
struct IdOf<PwmDuty> : std::integral_constant<MessageId, MessageId::kPwmDuty> {};
template <>
struct IdOf<EncoderReport> : std::integral_constant<MessageId, MessageId::kEncoderReport> {};
template <>
struct IdOf<DigitalInputs> : std::integral_constant<MessageId, MessageId::kDigitalInputs> {};
template <>
struct IdOf<DigitalOutputs> : std::integral_constant<MessageId, MessageId::kDigitalOutputs> {};
template <>
struct IdOf<ForceSample> : std::integral_constant<MessageId, MessageId::kForceSample> {};
template <>
struct IdOf<CurrentSample> : std::integral_constant<MessageId, MessageId::kCurrentSample> {};
template <>
struct IdOf<Advance> : std::integral_constant<MessageId, MessageId::kAdvance> {};
template <>
struct IdOf<Advanced> : std::integral_constant<MessageId, MessageId::kAdvanced> {};
template <>
struct IdOf<Heartbeat> : std::integral_constant<MessageId, MessageId::kHeartbeat> {};
template <>
struct IdOf<Fault> : std::integral_constant<MessageId, MessageId::kFault> {};
template <>
struct IdOf<Bye> : std::integral_constant<MessageId, MessageId::kBye> {};
template <>
struct IdOf<Reference> : std::integral_constant<MessageId, MessageId::kReference> {};
template <>
struct IdOf<Reset> : std::integral_constant<MessageId, MessageId::kReset> {};
template <>
struct IdOf<AbsoluteCount> : std::integral_constant<MessageId, MessageId::kAbsoluteCount> {};

}  // namespace towbench::protocol
