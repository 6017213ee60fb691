// A small reader of DBC files, written from the format's description and not from our layout:
// message and signal lines, and the extraction of Intel (little-endian) signals bit by bit.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "protocol/carriers/can_frame.h"

namespace towbench::protocol {

struct DbcSignal {
  std::string name;
  unsigned start = 0;
  unsigned length = 0;
  bool is_little_endian = false;
  bool is_signed = false;
  double min = 0.0;
  double max = 0.0;
  std::string unit;
};

struct DbcMessage {
  std::string name;
  unsigned size = 0;
  std::string sender;
  std::vector<DbcSignal> signals;
};

[[nodiscard]] std::map<std::uint32_t, DbcMessage> read_dbc(const std::string& path);

// Raw value of a little-endian signal.
[[nodiscard]] std::int64_t raw_value(const DbcSignal& signal, const CanFrame& frame);

}  // namespace towbench::protocol
