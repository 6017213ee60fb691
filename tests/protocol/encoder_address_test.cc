#include "protocol/carriers/encoder_address.h"

#include <gtest/gtest.h>

namespace towbench::protocol {
namespace {

TEST(EncoderAddress, SaysChipFirstLineIndexAndRating) {
  const auto plain = parse_encoder_address("gpiochip1");
  ASSERT_TRUE(plain.has_value());
  EXPECT_EQ(plain->place.chip, "gpiochip1");
  EXPECT_EQ(plain->place.first_line, 0U);
  EXPECT_FALSE(plain->place.with_index || plain->is_simulated);
  EXPECT_EQ(plain->rated_edges_per_s, 0.0);

  const auto full = parse_encoder_address("sim:gpiochip0+9:index@20000");
  ASSERT_TRUE(full.has_value());
  EXPECT_EQ(full->place.chip, "gpiochip0");
  EXPECT_EQ(full->place.first_line, 9U);
  EXPECT_TRUE(full->place.with_index && full->is_simulated);
  EXPECT_EQ(full->rated_edges_per_s, 20'000.0);
}

TEST(EncoderAddress, RefusesWhatIsNone) {
  for (const char* text :
       {"", "sim:", "+3", "gpiochip0+", "gpiochip0+x", "gpiochip0@", "gpiochip0@0", "gpiochip0@1e3",
        "gpiochip0:indexes", "gpiochip0:index+9", "gpiochip0@5+9", "gpiochip0+-1"}) {
    const auto address = parse_encoder_address(text);
    ASSERT_FALSE(address.has_value()) << text;
    EXPECT_NE(address.error().message.find(std::string(kEncoderLineForms)), std::string::npos);
  }
}

TEST(EncoderAddress, NamesTheChipThatCannotBeOpened) {
  const auto reader = open_edge_reader(*parse_encoder_address("no-such-chip"));
  ASSERT_FALSE(reader.has_value());
  EXPECT_TRUE(reader.error().message.starts_with("no-such-chip: no such GPIO chip"));
  const auto driver = open_edge_driver(*parse_encoder_address("sim:no-such-chip"));
  ASSERT_FALSE(driver.has_value());
  EXPECT_TRUE(driver.error().message.starts_with("no-such-chip: is no simulated GPIO chip"));
  EXPECT_FALSE(open_edge_reader(*parse_encoder_address("sim:gpiochip0")).has_value());
}

}  // namespace
}  // namespace towbench::protocol
