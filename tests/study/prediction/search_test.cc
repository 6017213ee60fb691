// A search that is told to end before it revises what it has accepted.
#include "study/prediction/search.h"

#include <gtest/gtest.h>

#include "tests/study/prediction/simulated_run.h"

namespace towbench::tests {
namespace {

using namespace study::diagnose;

class SearchThatIsAsked : public ::testing::Test {
 protected:
  // Whether to go on with each answer, of a run with quadratic drag.
  Search search(bool goes_on) {
    truth_[Key::kDrag] = 20;
    runs_ = {simulated_run(truth_, 10, 5e-6)};
    data_ = make_data(runs_, stated_);
    return search_causes(data_, make_context(stated_, data_),
                         {parameters_of(stated_), std::vector<OfRun>(1)}, Limits{},
                         [&](const Search& so_far) {
                           accepted_ = so_far.final.accepted.size();
                           ++asked_;
                           return goes_on;
                         });
  }

  NominalModel stated_ = simple_model();
  Parameters truth_ = parameters_of(stated_);
  std::vector<study::diagnose::Run> runs_;
  Data data_;
  std::size_t accepted_ = 0;
  int asked_ = 0;
};

TEST_F(SearchThatIsAsked, EndsWithWhatIsAcceptedAndNamesNothing) {
  const Search found = search(false);
  EXPECT_EQ(asked_, 1);
  EXPECT_GE(accepted_, 1);
  EXPECT_EQ(found.final.accepted.size(), accepted_);
  EXPECT_TRUE(found.causes.empty());
}

TEST_F(SearchThatIsAsked, GoesOnToTheCause) {
  const Search found = search(true);
  EXPECT_EQ(asked_, 1);
  ASSERT_EQ(found.causes.size(), 1);
  EXPECT_EQ(found.causes.front().effect->name, "quadratic_drag");
}

}  // namespace
}  // namespace towbench::tests
