// The messages of an MCAP file in the order in which they are stored (https://mcap.dev/spec).
//
// Chunks may be plain, lz4 or zstd. Indexes, attachments and metadata are passed over: a file whose
// end is missing is read as far as it goes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace towbench::study::logs {

struct McapChannel {
  std::string topic;
  std::string encoding;  // of its messages, "json" for one
};

struct McapMessage {
  std::uint16_t channel = 0;
  std::uint64_t log_time_ns = 0;
  std::string_view data;
};

struct McapEnd {
  std::string damage;       // what is wrong, and at which byte; empty when all was read
  bool ends_whole = false;  // with the record that ends the data
};

using McapChannels = std::map<std::uint16_t, McapChannel>;
// Called for each message; false ends the reading.
using McapVisitor = std::function<bool(const McapMessage&, const McapChannels&)>;

inline constexpr std::string_view kMcapMagic = "\x89MCAP0\r\n";

[[nodiscard]] McapEnd read_mcap(const std::filesystem::path& path, const McapVisitor& visit);

}  // namespace towbench::study::logs
