// The reader of images: a good one, and files that lie.
#include "board/elf_image.h"

#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "tests/board/small_image.h"

namespace towbench::board {
namespace {

TEST(ElfImage, ReadsEntrySegmentAndSymbols) {
  const auto image = ElfImage::parse(small_image({0xE320F003U, 0xEAFFFFFDU}));
  ASSERT_TRUE(image) << image.error();
  EXPECT_EQ(image->entry(), kSmallImageAddress);
  ASSERT_EQ(image->segments().size(), 1U);
  EXPECT_EQ(image->segments()[0].bytes.size(), 8U);
  EXPECT_EQ(image->describe(kSmallImageAddress + 4), "start+0x4");
  EXPECT_EQ(image->describe(0x100), "before every symbol");
}

TEST(ElfImage, RefusesWhatIsNoImageWithASentence) {
  const auto refusal = [](std::vector<std::uint8_t> bytes) {
    const auto image = ElfImage::parse(bytes);
    return image ? std::string{} : image.error();
  };
  EXPECT_EQ(refusal({}), "the ELF header reaches beyond the end of the file");
  EXPECT_EQ(refusal(std::vector<std::uint8_t>(100, 0)).substr(0, 17), "it is no ELF file");
  auto bytes = small_image({0xE320F003U});
  auto wrong = bytes;
  wrong[4] = 2;
  EXPECT_EQ(refusal(wrong), "it is no 32-bit little-endian ELF file");
  wrong = bytes;
  wrong[18] = 62;
  EXPECT_EQ(refusal(wrong), "it is for machine 62, not for ARM (40)");
  wrong = bytes;
  wrong[44] = 0;
  EXPECT_NE(refusal(wrong), "");
}

// Every single byte overwritten, and every length: a refusal or an image, never anything else.
TEST(ElfImage, NoDamagedFileIsReadBeyondItsEnd) {
  const auto good = small_image({0xE320F003U, 0xEAFFFFFDU});
  for (std::size_t at = 0; at < good.size(); ++at) {
    for (const unsigned value : {0x00U, 0x7FU, 0x80U, 0xFFU}) {
      auto bytes = good;
      bytes[at] = static_cast<std::uint8_t>(value);
      if (const auto image = ElfImage::parse(bytes)) {
        for (const ElfSegment& segment : image->segments()) {
          EXPECT_LE(segment.bytes.size(), good.size());
          EXPECT_GE(segment.memory_size, segment.bytes.size());
        }
        static_cast<void>(image->describe(kSmallImageAddress));
      }
    }
    const std::vector<std::uint8_t> cut(good.begin(),
                                        good.begin() + static_cast<std::ptrdiff_t>(at));
    static_cast<void>(ElfImage::parse(cut));
  }
}

}  // namespace
}  // namespace towbench::board
