#include "harness/record/message_record.h"

#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>

#include "protocol/each_message.h"
#include "protocol/wire.h"

namespace towbench::harness {
namespace {

struct UntilAdvance final : protocol::EachMessage<UntilAdvance> {
  explicit UntilAdvance(protocol::MessageSink& sink) noexcept : to(sink) {}
  template <typename Message>
  void handle(const Message& message) noexcept {
    to.on(message);
  }
  void handle(const protocol::Advance& advance) noexcept { end = advance; }

  protocol::MessageSink& to;
  std::optional<protocol::Advance> end;
};

}  // namespace

void MessageRecord::WriteBytes::operator()(std::span<const std::byte> bytes) const noexcept {
  file->write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});  // NOLINT
}

core::Status MessageRecord::Bytes::write(std::span<const std::byte> bytes) noexcept {
  blocks.add(bytes);
  return {};
}

void MessageRecord::flush() noexcept {
  (void)frames_.flush();
  bytes_.blocks.hand_over();
  writer_.wait();
  file_.flush();
}

MessageReplay::MessageReplay(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw std::filesystem::filesystem_error("cannot read", path,
                                            std::make_error_code(std::errc::io_error));
  }
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const auto bytes = std::as_bytes(std::span(text));
  bytes_.assign(bytes.begin(), bytes.end());
}

bool MessageReplay::play_turn(protocol::MessageSink& to, protocol::Advance& end) {
  UntilAdvance turn(to);
  // Frame by frame, so that nothing of the next turn is heard.
  while (!turn.end && good()) {
    const auto rest = std::span(bytes_).subspan(at_);
    if (rest.size() < protocol::kFrameOverhead) {
      whole_ = rest.empty();
      return false;
    }
    const std::size_t size =
        protocol::load_little_endian<std::uint16_t>(rest.data()) + protocol::kFrameOverhead;
    if (size > rest.size()) {
      whole_ = false;
      return false;
    }
    reader_.feed(rest.first(size), turn);
    at_ += size;
  }
  end = turn.end.value_or(end);
  return turn.end.has_value();
}

}  // namespace towbench::harness
