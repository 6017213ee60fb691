#include "harness/panel/truth_tail.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "harness/record/plant_recorder.h"

namespace towbench::harness {
namespace {

class TruthTailTest : public ::testing::Test {
 protected:
  ~TruthTailTest() override { std::filesystem::remove_all(folder_); }
  void append(const char* text) const {
    std::ofstream(folder_ / "truth.csv", std::ios::app) << text;
  }
  std::filesystem::path folder_ = [] {
    auto pattern = (std::filesystem::temp_directory_path() / "towbench-tail-XXXXXX").string();
    return std::filesystem::path(mkdtemp(pattern.data()));
  }();
};

TEST_F(TruthTailTest, ReadsWhatTheRecorderWrote) {
  emulator::TruthRow row;
  row.time_ns = 1'500'000'000;
  row.axes[core::Axis::kY].carriage_m = 1.25;
  row.axes[core::Axis::kY].transmission_force_N = -3.5;
  row.axes[core::Axis::kX].carriage_speed_m_per_s = 0.125;
  row.axes[core::Axis::kX].current_A = 2;
  row.input_lines = 0x15;
  {
    PlantRecorder recorder(folder_, {});
    recorder.on_truth(row);
    recorder.on_event({.time_ns = 7, .kind = emulator::PlantEventKind::kPeerLost});
  }
  TruthTail tail(folder_);
  const auto rows = tail.rows();
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].time_ns, row.time_ns);
  EXPECT_EQ(rows[0].axis(core::Axis::kY).carriage_m, 1.25);
  EXPECT_EQ(rows[0].axis(core::Axis::kY).transmission_force_N, -3.5F);
  EXPECT_EQ(rows[0].axis(core::Axis::kX).carriage_speed_m_per_s, 0.125F);
  EXPECT_EQ(rows[0].axis(core::Axis::kX).current_A, 2.0F);
  EXPECT_EQ(rows[0].input_lines, 0x15);
  EXPECT_NE(tail.events().find("peer_lost"), std::string::npos);
  EXPECT_TRUE(tail.rows().empty());
  EXPECT_TRUE(tail.events().empty());
}

TEST_F(TruthTailTest, ALineIsARowOnceItIsWhole) {
  TruthTail tail(folder_);
  EXPECT_TRUE(tail.rows().empty()) << "no file yet";
  append("time_s,whatever\n0.001,1,2,3,4,5,6,7,8,9,10,11,12,1,2,3,4,5,6,7,8,9,10,11,12");
  EXPECT_TRUE(tail.rows().empty());
  append(",5\n0.002,1,2\nrubbish\n0.003,");
  const auto rows = tail.rows();
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].time_ns, 1'000'000);
  EXPECT_EQ(rows[0].input_lines, 5);
}

}  // namespace
}  // namespace towbench::harness
