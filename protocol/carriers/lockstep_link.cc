#include "protocol/carriers/lockstep_link.h"

namespace towbench::protocol {

template <typename Writer, typename Reader>
BasicLockstepLink<Writer, Reader>::BasicLockstepLink(ByteStream& stream,
                                                     core::Nanoseconds silence_limit_ns) noexcept
    : TurnLink(silence_limit_ns), stream_(stream), writer_(stream) {}

template <typename Writer, typename Reader>
auto BasicLockstepLink<Writer, Reader>::read_once(core::Nanoseconds timeout_ns) noexcept
    -> core::Result<Progress> {
  // A peer that has gone may have left a last word: read on. Any other failure to send is final.
  if (const auto sent = writer_.status(); !sent && sent.error() != core::ErrorCode::kPeerClosed) {
    return core::failure(sent.error());
  }
  const auto size = stream_.read_some(received_, timeout_ns);
  if (!size) {
    reader_.finish(watch());
    return core::failure(size.error());
  }
  if (*size == 0) {
    return Progress::kNothing;
  }
  bytes_received_ += *size;
  reader_.feed(std::span(received_).first(*size), watch());
  return Progress::kSomething;
}

template class BasicLockstepLink<FrameWriter, FrameReader>;
template class BasicLockstepLink<CobsWriter, CobsReader>;

}  // namespace towbench::protocol
