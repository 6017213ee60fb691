// Any bytes: decoding does not crash, and what it accepts means exactly these bytes.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/check.h"
#include "protocol/codec.h"
#include "protocol/each_message.h"

namespace towbench::protocol {
namespace {

class EncodeAgain final : public EachMessage<EncodeAgain> {
 public:
  explicit EncodeAgain(std::span<const std::byte> original) : original_(original) {}

  template <typename Message>
  void handle(const Message& message) noexcept {
    std::vector<std::byte> bytes(encoded_size(message));
    core::check(encode(message, bytes) == bytes.size());
    core::check(is_plausible(bytes[0], bytes.size()));
    // Only the greeting of a later version may say more than we know.
    core::check(bytes.size() <= original_.size());
    core::check(std::equal(bytes.begin(), bytes.end(), original_.begin()));
  }

 private:
  std::span<const std::byte> original_;
};

}  // namespace
}  // namespace towbench::protocol

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace towbench::protocol;
  static Decoder decoder;
  const auto payload = std::as_bytes(std::span(data, size));
  EncodeAgain sink(payload);
  (void)decoder.decode(payload, sink);
  return 0;
}
