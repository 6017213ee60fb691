// An ELF executable for 32-bit little-endian ARM: what is loaded where, and which names its
// addresses have.
//
// Every offset and size of the file is checked against its length; a file that lies about itself is
// refused with a sentence, whatever else it holds.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

namespace towbench::board {

struct ElfSegment {
  std::uint32_t address = 0;      // physical
  std::uint32_t memory_size = 0;  // >= bytes.size(); the rest is zero
  bool writable = false;
  std::vector<std::uint8_t> bytes;
};

struct ElfSymbol {
  std::string name;
  std::uint32_t address = 0;  // without the Thumb bit
  std::uint32_t size = 0;
  bool is_function = false;
};

class ElfImage {
 public:
  // What is wrong with the file, in a sentence without its name.
  using Refusal = std::string;
  [[nodiscard]] static tl::expected<ElfImage, Refusal> parse(std::span<const std::uint8_t> file);
  [[nodiscard]] static tl::expected<ElfImage, Refusal> read(const std::string& path);

  // Bit 0: the first instruction is Thumb.
  [[nodiscard]] std::uint32_t entry() const noexcept { return entry_; }
  [[nodiscard]] std::span<const ElfSegment> segments() const noexcept { return segments_; }
  // Sorted by address.
  [[nodiscard]] std::span<const ElfSymbol> symbols() const noexcept { return symbols_; }
  [[nodiscard]] std::optional<ElfSymbol> find(std::string_view name) const;
  // The function or object that holds an address, or else the nearest below it: "main+0x1c".
  // "no symbols" in a stripped image, "before every symbol" below the first.
  [[nodiscard]] std::string describe(std::uint32_t address) const;
  // Index into symbols() of the function that holds an address; -1 for none.
  [[nodiscard]] int function_at(std::uint32_t address) const;

 private:
  std::uint32_t entry_ = 0;
  std::vector<ElfSegment> segments_;
  std::vector<ElfSymbol> symbols_;
};

}  // namespace towbench::board
