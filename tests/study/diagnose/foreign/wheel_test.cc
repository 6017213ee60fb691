// A wheel out of round and a polygon of links, of another maker: its load is but a part of what
// moves and of what rubs, and no file says which.
#include <gtest/gtest.h>

#include "tests/study/diagnose/foreign/answer.h"
#include "tests/study/diagnose/foreign/drawn_case.h"

namespace towbench::tests::foreign {
namespace {

std::string answer_to(const char* effect, std::uint64_t seed) {
  Wish wish;
  wish.kind = "one";
  wish.effect = effect;
  return answer_of(study::diagnose::diagnose(request_of(draw_case(wish, seed)))).words();
}

// With all of dry friction behind the wheel a deadband and less friction stood beside it.
TEST(AForeignWheel, OutOfRoundIsNamedWithoutWhatItsFrictionIsNot) {
  EXPECT_EQ(answer_to("sprocket_eccentricity", 131007), "sprocket_eccentricity");
}

// Two sessions, of which one moves one way: what both have alike is the model's.
TEST(AForeignWheel, OutOfRoundIsNamedWithoutWhatSessionsDifferBy) {
  EXPECT_EQ(answer_to("sprocket_eccentricity", 131001), "sprocket_eccentricity");
}

// As a wave of the reading alone it was not seen.
TEST(AForeignWheel, OfLinksMovesTheLoadFasterAndSlower) {
  EXPECT_EQ(answer_to("chain_polygon", 135012), "chain_polygon");
}

// By force it is little where the correction is slow: a tooth passes too fast for it.
TEST(AForeignWheel, OfLinksIsNamedByItsWay) {
  EXPECT_EQ(answer_to("chain_polygon", 135013), "chain_polygon");
}

}  // namespace
}  // namespace towbench::tests::foreign
