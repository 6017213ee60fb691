// One peripheral's register window, as the processor sees it: words of 32 bit, reached in bytes,
// halfwords or words. A peripheral overrides the words that do something; the others keep what is
// written to them, with a note.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "board/bus.h"

namespace towbench::board {

class RegisterBlock {
 public:
  // The bus outlives this. `size` in bytes, a multiple of 4.
  RegisterBlock(std::string name, std::uint32_t size, Bus& bus);
  RegisterBlock(const RegisterBlock&) = delete;
  RegisterBlock& operator=(const RegisterBlock&) = delete;
  virtual ~RegisterBlock() = default;

  // Accesses of 1, 2 or 4 bytes below size(); one that crosses a word is two.
  [[nodiscard]] std::uint32_t load(std::uint32_t offset, unsigned bytes);
  void store(std::uint32_t offset, unsigned bytes, std::uint32_t value);

  // What is due up to `now_ns` happens; the time never goes back.
  virtual void advance(core::Nanoseconds now_ns) { static_cast<void>(now_ns); }
  // When something readable or an interrupt will next change by itself.
  [[nodiscard]] virtual core::Nanoseconds next_event_ns() const { return kNever; }
  virtual void reset();
  // Registers that hold what was written and never change by themselves.
  [[nodiscard]] virtual bool is_configuration() const noexcept { return false; }

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] std::uint32_t size() const noexcept { return size_; }

 protected:
  // `offset` is a multiple of 4; `lanes` has a byte of ones for each byte that is accessed.
  [[nodiscard]] virtual std::uint32_t read_word(std::uint32_t offset, std::uint32_t lanes);
  virtual void write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes);

  [[nodiscard]] std::uint32_t& stored(std::uint32_t offset) { return words_[offset / 4]; }
  [[nodiscard]] std::uint32_t stored(std::uint32_t offset) const { return words_[offset / 4]; }
  // The bytes of `lanes` of a stored word change, the others stay.
  void keep(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes);
  // Once for each text.
  void note(const std::string& text);
  [[nodiscard]] Bus& bus() noexcept { return bus_; }
  [[nodiscard]] const Bus& bus() const noexcept { return bus_; }

 private:
  std::string name_;
  std::uint32_t size_;
  Bus& bus_;
  std::vector<std::uint32_t> words_;
};

}  // namespace towbench::board
