// What a held-out run does not have is not named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/study/diagnose/hidden_case.h"

namespace towbench::tests {
namespace {

using study::diagnose::Diagnosis;
using study::diagnose::Run;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

HiddenAxis axis_with(const char* effect) {
  HiddenAxis axis;
  axis.effect = effect;
  axis.duration_s = 15;
  return axis;
}

Run run_with(const char* effect, std::uint64_t seed) {
  const HiddenAxis axis = axis_with(effect);
  return run_of(axis, make_hidden_log(axis, seed));
}

Diagnosis diagnosis_of(Run fitted, Run held_out) {
  study::diagnose::Request request;
  request.model = nominal_of(axis_with(""));
  request.runs = {std::move(fitted)};
  request.holdout = {std::move(held_out)};
  return study::diagnose::diagnose(request);
}

TEST(Refutation, IsByAHeldOutRunThatDoesNotHaveTheForce) {
  const Diagnosis d = diagnosis_of(run_with("position_force", 1), run_with("", 2));
  EXPECT_THAT(d.causes, IsEmpty());
  EXPECT_THAT(d.refuted, ElementsAre("position_force"));
  EXPECT_THAT(d.verdicts, ElementsAre("unexplained_structure"));
  ASSERT_TRUE(d.unexplained.has_value());
  EXPECT_GT(d.unexplained->rms_N, 0.1);
}

TEST(Refutation, IsByAHeldOutRunWhoseDragIsAsStated) {
  HiddenAxis thick = axis_with("");
  thick.viscous_N_s_per_m *= 1.5;
  const Diagnosis d = diagnosis_of(run_of(thick, make_hidden_log(thick, 1)), run_with("", 2));
  EXPECT_THAT(d.refuted, ElementsAre("viscous"));
  EXPECT_THAT(d.verdicts, ElementsAre("unexplained_structure"));
}

}  // namespace
}  // namespace towbench::tests
