// Registers of a block that is not modelled: they hold what is written, and nothing happens. Each
// access is noted once. An image that reads what the hardware changes (a sample, a state, a time),
// or reads again what it has not written, goes by a value that nobody computes: the first such
// register is told (Bus::doubt), and the run proves nothing. A single read of another before a
// write changes some bits and keeps the others, as start-up code does.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "board/register_block.h"

namespace towbench::board {

class KeptRegisters final : public RegisterBlock {
 public:
  KeptRegisters(std::string name, std::uint32_t size, Bus& bus);

  void reset() override;
  [[nodiscard]] bool is_configuration() const noexcept override { return true; }

 protected:
  std::uint32_t read_word(std::uint32_t offset, std::uint32_t lanes) override;
  void write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) override;

 private:
  enum class Use : std::uint8_t { kNone, kReadOnce, kWritten, kVolatile };
  void forget();
  std::vector<Use> uses_;
};

}  // namespace towbench::board
