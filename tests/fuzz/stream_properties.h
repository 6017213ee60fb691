// What any bytes must do to a stream reader, for every framing.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/check.h"
#include "protocol/codec.h"
#include "protocol/each_message.h"
#include "protocol/link_counts.h"

namespace towbench::protocol {

class KeepPayloads final : public EachMessage<KeepPayloads> {
 public:
  template <typename Message>
  void handle(const Message& message) noexcept {
    std::vector<std::byte> bytes(encoded_size(message));
    core::check(encode(message, bytes) == bytes.size());
    payloads.push_back(std::move(bytes));
  }
  std::vector<std::vector<std::byte>> payloads;
};

// No crash; every delivery is counted; and it does not matter how the bytes are cut into portions.
// The first byte of `input` is the size of the portions.
template <typename Reader>
void check_reader(std::span<const std::byte> input) {
  if (input.empty()) {
    return;
  }
  const auto portion = 1 + std::to_integer<std::size_t>(input[0]);
  const auto bytes = input.subspan(1);

  // Not value-initialised: clearing their buffers would cost more than the check.
  const std::unique_ptr<Reader> whole(new Reader);
  const std::unique_ptr<Reader> in_portions(new Reader);
  KeepPayloads from_whole;
  KeepPayloads from_portions;
  whole->feed(bytes, from_whole);
  whole->finish(from_whole);
  for (std::size_t at = 0; at < bytes.size(); at += portion) {
    in_portions->feed(bytes.subspan(at, std::min(portion, bytes.size() - at)), from_portions);
  }
  in_portions->finish(from_portions);

  core::check(whole->counts() == in_portions->counts());
  core::check(from_whole.payloads == from_portions.payloads);
  core::check(whole->counts().frames == from_whole.payloads.size());
}

}  // namespace towbench::protocol
