#include "tests/protocol/dbc_reader.h"

#include <fstream>
#include <regex>

namespace towbench::protocol {

std::map<std::uint32_t, DbcMessage> read_dbc(const std::string& path) {
  static const std::regex message_line(R"(^BO_ (\d+) (\w+): (\d+) (\w+)\s*$)");
  static const std::regex signal_line(
      R"re(^ SG_ (\w+) : (\d+)\|(\d+)@([01])([+-]) \(1,0\) \[(-?\d+)\|(\d+)\] "(\w*)" \w+\s*$)re");
  std::map<std::uint32_t, DbcMessage> messages;
  DbcMessage* current = nullptr;
  std::ifstream file(path);
  std::smatch m;
  for (std::string line; std::getline(file, line);) {
    if (std::regex_match(line, m, message_line)) {
      current = &messages[static_cast<std::uint32_t>(std::stoul(m[1]))];
      *current = {m[2], static_cast<unsigned>(std::stoul(m[3])), m[4], {}};
    } else if (current != nullptr && std::regex_match(line, m, signal_line)) {
      current->signals.push_back({m[1], static_cast<unsigned>(std::stoul(m[2])),
                                  static_cast<unsigned>(std::stoul(m[3])), m[4] == "1", m[5] == "-",
                                  std::stod(m[6]), std::stod(m[7]), m[8]});
    }
  }
  return messages;
}

std::int64_t raw_value(const DbcSignal& signal, const CanFrame& frame) {
  std::uint64_t value = 0;
  for (unsigned i = 0; i < signal.length; ++i) {
    const unsigned bit = signal.start + i;
    const auto byte = static_cast<unsigned>(frame.data[bit / 8]);
    const std::uint64_t set = (byte >> (bit % 8)) & 1U;
    value |= set << i;
  }
  const bool is_negative =
      signal.is_signed && signal.length < 64 && ((value >> (signal.length - 1)) & 1U) != 0;
  if (is_negative) {
    value |= ~std::uint64_t{0} << signal.length;
  }
  return static_cast<std::int64_t>(value);
}

}  // namespace towbench::protocol
