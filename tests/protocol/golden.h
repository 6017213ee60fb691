// One message of every kind with its exact bytes, written by hand from docs/reference/protocol.md.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "protocol/message_sink.h"

namespace towbench::protocol {

struct Golden {
  std::string name;
  std::string payload_hex;  // spaces between fields
  void (*send)(MessageSink& sink);
};

[[nodiscard]] const std::vector<Golden>& golden_messages();

[[nodiscard]] std::vector<std::byte> bytes_of(const std::string& hex);
[[nodiscard]] std::string hex_of(const std::byte* bytes, std::size_t size);

}  // namespace towbench::protocol
