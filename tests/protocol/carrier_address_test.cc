#include "protocol/carriers/carrier_address.h"

#include <gtest/gtest.h>

namespace towbench::protocol {
namespace {

TEST(CarrierAddress, ReadsEverySchemeAndWritesItAgain) {
  for (const std::string text :
       {"local:/run/towbench/plant", "serial:/dev/ttyUSB0@115200", "serial:/dev/pts/3@921600",
        "can:vcan0", "can:vcan0@500000", "can:vcan0@fd", "can:vcan0@1000000/5000000"}) {
    const auto address = parse_carrier_address(text);
    ASSERT_TRUE(address.has_value()) << text;
    EXPECT_EQ(address->text(), text);
  }
  EXPECT_EQ(parse_carrier_address("serial:/dev/ttyS1")->baud, kDefaultBaud);
}

TEST(CarrierAddress, RefusesWhatIsNoneAndSaysWhatIsAllowed) {
  for (const std::string text :
       {"", "can", "can:", "tcp:0.0.0.0:80", "serial:@115200", "serial:/dev/ttyS1@fast",
        "serial:/dev/ttyS1@0", "serial:x@", "can:vcan0@", "can:vcan0@0", "can:vcan0@1M",
        "can:vcan0@1000/", "can:vcan0@/1000", "can:vcan0@1/2/3"}) {
    const auto address = parse_carrier_address(text);
    ASSERT_FALSE(address.has_value()) << text;
    EXPECT_NE(address.error().message.find(std::string(kAddressForms)), std::string::npos);
  }
}

TEST(CarrierAddress, ReadsBothEndsOfAWire) {
  const auto line = parse_carrier_ends("serial:/dev/a,/dev/b@115200");
  ASSERT_TRUE(line.has_value());
  EXPECT_EQ(line->controller.text(), "serial:/dev/a@115200");
  EXPECT_EQ(line->plant.text(), "serial:/dev/b@115200");
  EXPECT_EQ(parse_carrier_ends("can:can0")->plant.place, "can0");
  EXPECT_EQ(parse_carrier_ends("can:can0,can1")->plant.place, "can1");
  EXPECT_EQ(parse_carrier_ends("can:vcan0,vcan1@125000")->plant.text(), "can:vcan1@125000");
  EXPECT_EQ(parse_carrier_ends("can:vcan0,vcan1@125000")->controller.text(), "can:vcan0@125000");
  for (const std::string text : {"serial:/dev/a", "can:can0,", "can:,can0", "local:/tmp/x"}) {
    EXPECT_FALSE(parse_carrier_ends(text).has_value()) << text;
  }
}

}  // namespace
}  // namespace towbench::protocol
