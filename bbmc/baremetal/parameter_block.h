// The parameters of an image as a block of 8-byte words that a programmer can write into the file
// or a bench into memory before the image starts: every value in the order of visit(), guarded by a
// hash of the keys, so that an image never takes a block that was made for another one.
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/bounded_vector.h"
#include "core/parameter.h"

namespace towbench::bbmc {

struct ParameterBlock {
  static constexpr std::uint32_t kMagic = 0x4D42'4250;  // "PBBM"
  static constexpr std::size_t kMostWords = 1024;

  std::uint32_t magic = kMagic;
  std::uint32_t count = 0;  // words in use; 0: the image's own defaults
  std::uint64_t keys = 0;   // ParameterKeys::value() of both sides
  std::array<std::uint64_t, kMostWords> words{};
};
// The image's symbol of its block.
inline constexpr const char* kParameterBlockSymbol = "bbmc_parameters";

// FNV-1a over the keys.
class ParameterKeys {
 public:
  [[nodiscard]] std::uint64_t value() const noexcept { return hash_; }

  template <typename Field>
  void value(std::string_view key, Field& /*field*/, core::Range /*range*/,
             std::string_view /*meaning*/) {
    add(key);
  }
  template <std::size_t Capacity>
  void list(std::string_view key, core::BoundedVector<double, Capacity>& /*field*/,
            core::Range /*range*/, std::string_view /*meaning*/) {
    add(key);
  }
  template <typename Nested>
  void group(std::string_view key, Nested& nested, std::string_view /*meaning*/) {
    add(key);
    nested.visit(*this);
  }

 private:
  void add(std::string_view key) noexcept {
    for (const char c : key) {
      hash_ = (hash_ ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    }
    hash_ = (hash_ ^ 0U) * 0x100000001b3U;
  }

  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

// Packs into or unpacks from the block; a block that is full or at its end clears good().
template <bool kPack>
class ParameterWords {
 public:
  explicit ParameterWords(ParameterBlock& block) noexcept : block_(block) {}

  [[nodiscard]] bool good() const noexcept { return good_; }
  [[nodiscard]] std::uint32_t words() const noexcept { return next_; }

  void value(std::string_view /*key*/, double& field, core::Range /*range*/,
             std::string_view /*meaning*/) {
    exchange(
        field, [](double v) { return std::bit_cast<std::uint64_t>(v); },
        [](std::uint64_t w) { return std::bit_cast<double>(w); });
  }
  template <typename Integral>
  requires std::integral<Integral> || std::is_enum_v<Integral>
  void value(std::string_view /*key*/, Integral& field, core::Range /*range*/,
             std::string_view /*meaning*/) {
    exchange(
        field, [](Integral v) { return static_cast<std::uint64_t>(v); },
        [](std::uint64_t w) { return static_cast<Integral>(w); });
  }
  template <std::size_t Capacity>
  void list(std::string_view key, core::BoundedVector<double, Capacity>& field, core::Range range,
            std::string_view meaning) {
    std::uint64_t size = field.size();
    value(key, size, range, meaning);
    std::array<double, Capacity> items{};
    for (std::size_t i = 0; i < field.size(); ++i) {
      items[i] = field[i];
    }
    if (size > Capacity) {
      good_ = false;
      return;
    }
    for (std::size_t i = 0; i < size; ++i) {
      value(key, items[i], range, meaning);
    }
    field.assign(std::span<const double>(items).first(static_cast<std::size_t>(size)));
  }
  template <typename Nested>
  void group(std::string_view /*key*/, Nested& nested, std::string_view /*meaning*/) {
    nested.visit(*this);
  }

 private:
  template <typename Field, typename ToWord, typename FromWord>
  void exchange(Field& field, ToWord to_word, FromWord from_word) {
    const std::size_t end = kPack ? ParameterBlock::kMostWords : block_.count;
    if (!good_ || next_ >= end || next_ >= ParameterBlock::kMostWords) {
      good_ = false;
      return;
    }
    if constexpr (kPack) {
      block_.words[next_] = to_word(field);
    } else {
      field = from_word(block_.words[next_]);
    }
    ++next_;
  }

  ParameterBlock& block_;
  std::uint32_t next_ = 0;
  bool good_ = true;
};

// False when the parameters do not fit.
template <typename Parameters>
[[nodiscard]] bool pack(Parameters parameters, ParameterBlock& block) {
  ParameterKeys keys;
  parameters.visit(keys);
  ParameterWords<true> words(block);
  parameters.visit(words);
  block.magic = ParameterBlock::kMagic;
  block.keys = keys.value();
  block.count = words.words();
  return words.good();
}

// False when the block was made for other parameters; then nothing has changed. A block without
// words leaves the defaults.
template <typename Parameters>
[[nodiscard]] bool unpack(ParameterBlock& block, Parameters& parameters) {
  if (block.count == 0) {
    return true;
  }
  Parameters read = parameters;
  ParameterKeys keys;
  read.visit(keys);
  ParameterWords<false> words(block);
  read.visit(words);
  const bool good = block.magic == ParameterBlock::kMagic && block.keys == keys.value() &&
                    words.good() && words.words() == block.count;
  if (good) {
    parameters = read;
  }
  return good;
}

}  // namespace towbench::bbmc
