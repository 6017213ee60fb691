#include "board/elf_image.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

namespace towbench::board {
namespace {

constexpr std::uint16_t kArm = 40;
constexpr std::uint16_t kExecutable = 2;
constexpr std::uint32_t kLoad = 1;
constexpr std::uint32_t kSymbolTable = 2;
constexpr std::uint32_t kWritable = 2;
constexpr std::size_t kHeaderSize = 52;
constexpr std::size_t kSegmentSize = 32;
constexpr std::size_t kSectionSize = 40;
constexpr std::size_t kSymbolSize = 16;
// More than a bare-metal image has; a file beyond is a mistake or an attack.
constexpr std::size_t kLargestFile = 256U << 20U;
constexpr std::size_t kMostSegments = 64;
constexpr std::size_t kMostSymbols = 1'000'000;

struct Damaged {
  std::string why;
};

// Reads numbers of a file that may be shorter than it says.
class Bytes {
 public:
  explicit Bytes(std::span<const std::uint8_t> data) : data_(data) {}

  [[nodiscard]] std::span<const std::uint8_t> part(std::uint64_t offset, std::uint64_t size,
                                                   const char* what) const {
    if (offset > data_.size() || size > data_.size() - offset) {
      throw Damaged{fmt::format("{} reaches beyond the end of the file", what)};
    }
    return data_.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(size));
  }
  [[nodiscard]] std::uint32_t word(std::uint64_t offset) const {
    const auto bytes = part(offset, 4, "a header");
    return static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8U |
           static_cast<std::uint32_t>(bytes[2]) << 16U |
           static_cast<std::uint32_t>(bytes[3]) << 24U;
  }
  [[nodiscard]] std::uint16_t half(std::uint64_t offset) const {
    const auto bytes = part(offset, 2, "a header");
    return static_cast<std::uint16_t>(bytes[0] | bytes[1] << 8U);
  }

 private:
  std::span<const std::uint8_t> data_;
};

void check_identity(const Bytes& file) {
  const auto identity = file.part(0, kHeaderSize, "the ELF header");
  constexpr std::uint8_t kMagic[4] = {0x7F, 'E', 'L', 'F'};
  if (std::memcmp(identity.data(), kMagic, sizeof kMagic) != 0) {
    throw Damaged{
        "it is no ELF file (a raw image for a boot loader lacks its addresses: give the ELF that "
        "it "
        "was made from)"};
  }
  if (identity[4] != 1 || identity[5] != 1) {
    throw Damaged{"it is no 32-bit little-endian ELF file"};
  }
  if (file.half(18) != kArm) {
    throw Damaged{fmt::format("it is for machine {}, not for ARM ({})", file.half(18), kArm)};
  }
  if (file.half(16) != kExecutable) {
    throw Damaged{"it is no executable (an object or a shared library?)"};
  }
}

std::vector<ElfSegment> read_segments(const Bytes& file) {
  const std::uint32_t table = file.word(28);
  const std::uint16_t stride = file.half(42);
  const std::uint16_t count = file.half(44);
  if (count == 0 || count > kMostSegments || stride < kSegmentSize) {
    throw Damaged{fmt::format("it has {} program headers of {} bytes", count, stride)};
  }
  std::vector<ElfSegment> segments;
  for (unsigned i = 0; i < count; ++i) {
    const std::uint64_t at = table + static_cast<std::uint64_t>(i) * stride;
    static_cast<void>(file.part(at, kSegmentSize, "a program header"));
    const std::uint32_t stored = file.word(at + 16);
    ElfSegment segment;
    segment.address = file.word(at + 12);
    segment.memory_size = file.word(at + 20);
    segment.writable = (file.word(at + 24) & kWritable) != 0;
    if (file.word(at) != kLoad || segment.memory_size == 0) {
      continue;
    }
    if (stored > segment.memory_size || segment.memory_size > 0xFFFF'FFFFU - segment.address) {
      throw Damaged{fmt::format("segment {} does not fit into memory", i)};
    }
    const auto bytes = file.part(file.word(at + 4), stored, "a segment");
    segment.bytes.assign(bytes.begin(), bytes.end());
    segments.push_back(std::move(segment));
  }
  if (segments.empty()) {
    throw Damaged{"it has nothing to load"};
  }
  return segments;
}

std::string text_at(std::span<const std::uint8_t> names, std::uint32_t offset) {
  if (offset >= names.size()) {
    return {};
  }
  const auto rest = names.subspan(offset);
  const auto end = std::find(rest.begin(), rest.end(), std::uint8_t{0});
  return {rest.begin(), end};
}

// $a, $t and $d mark code and data; they name nothing.
bool is_name(const std::string& name) {
  return !name.empty() && name[0] != '$';
}

void read_symbol_table(const Bytes& file, std::uint64_t section, std::uint64_t names_section,
                       std::vector<ElfSymbol>& symbols) {
  const auto names =
      file.part(file.word(names_section + 16), file.word(names_section + 20), "the symbols' names");
  const std::uint32_t start = file.word(section + 16);
  const std::uint32_t size = file.word(section + 20);
  static_cast<void>(file.part(start, size, "the symbol table"));
  const std::size_t count = std::min<std::size_t>(size / kSymbolSize, kMostSymbols);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t at = start + i * kSymbolSize;
    const unsigned type = file.part(at + 12, 1, "a symbol")[0] & 0xFU;
    const bool is_defined = file.half(at + 14) != 0;
    if (!is_defined || type > 2) {
      continue;
    }
    ElfSymbol symbol;
    symbol.name = text_at(names, file.word(at));
    symbol.is_function = type == 2;
    symbol.address = file.word(at + 4) & (symbol.is_function ? ~1U : ~0U);
    symbol.size = file.word(at + 8);
    if (is_name(symbol.name)) {
      symbols.push_back(std::move(symbol));
    }
  }
}

std::vector<ElfSymbol> read_symbols(const Bytes& file) {
  std::vector<ElfSymbol> symbols;
  const std::uint32_t table = file.word(32);
  const std::uint16_t stride = file.half(46);
  const std::uint16_t count = file.half(48);
  if (table == 0 || count == 0) {
    return symbols;  // stripped
  }
  if (stride < kSectionSize) {
    throw Damaged{fmt::format("its section headers have {} bytes", stride)};
  }
  const auto header = [&](std::uint32_t index) {
    const std::uint64_t at = table + static_cast<std::uint64_t>(index) * stride;
    static_cast<void>(file.part(at, kSectionSize, "a section header"));
    return at;
  };
  for (unsigned i = 0; i < count; ++i) {
    const std::uint64_t section = header(i);
    if (file.word(section + 4) != kSymbolTable) {
      continue;
    }
    const std::uint32_t names = file.word(section + 24);
    if (names >= count) {
      throw Damaged{"its symbol table has no names"};
    }
    read_symbol_table(file, section, header(names), symbols);
  }
  std::stable_sort(symbols.begin(), symbols.end(),
                   [](const auto& a, const auto& b) { return a.address < b.address; });
  return symbols;
}

}  // namespace

tl::expected<ElfImage, ElfImage::Refusal> ElfImage::parse(std::span<const std::uint8_t> data) {
  try {
    const Bytes file(data);
    check_identity(file);
    ElfImage image;
    image.entry_ = file.word(24);
    image.segments_ = read_segments(file);
    image.symbols_ = read_symbols(file);
    return image;
  } catch (const Damaged& damaged) {
    return tl::unexpected<Refusal>(damaged.why);
  }
}

tl::expected<ElfImage, ElfImage::Refusal> ElfImage::read(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    return tl::unexpected<Refusal>("it cannot be read");
  }
  std::vector<std::uint8_t> data;
  std::vector<char> chunk(1U << 16U);
  while (stream.read(chunk.data(), static_cast<std::streamsize>(chunk.size())) ||
         stream.gcount() > 0) {
    data.insert(data.end(), chunk.begin(), chunk.begin() + stream.gcount());
    if (data.size() > kLargestFile) {
      return tl::unexpected<Refusal>("it is larger than the board's memory");
    }
  }
  return parse(data);
}

std::optional<ElfSymbol> ElfImage::find(std::string_view name) const {
  for (const ElfSymbol& symbol : symbols_) {
    if (symbol.name == name) {
      return symbol;
    }
  }
  return std::nullopt;
}

int ElfImage::function_at(std::uint32_t address) const {
  auto after = std::upper_bound(symbols_.begin(), symbols_.end(), address,
                                [](std::uint32_t a, const ElfSymbol& s) { return a < s.address; });
  while (after != symbols_.begin()) {
    --after;
    if (after->is_function) {
      return static_cast<int>(after - symbols_.begin());
    }
  }
  return -1;
}

std::string ElfImage::describe(std::uint32_t address) const {
  if (symbols_.empty()) {
    return "no symbols";
  }
  const auto after =
      std::upper_bound(symbols_.begin(), symbols_.end(), address,
                       [](std::uint32_t a, const ElfSymbol& s) { return a < s.address; });
  if (after == symbols_.begin()) {
    return "before every symbol";
  }
  const int function = function_at(address);
  const ElfSymbol& nearest = *std::prev(after);
  const ElfSymbol* chosen = &nearest;
  if (function >= 0) {
    const ElfSymbol& candidate = symbols_[static_cast<std::size_t>(function)];
    if (candidate.size != 0 && address - candidate.address < candidate.size) {
      chosen = &candidate;
    }
  }
  const std::uint32_t within = address - chosen->address;
  return within == 0 ? chosen->name : fmt::format("{}+0x{:x}", chosen->name, within);
}

}  // namespace towbench::board
