#include "protocol/tee_sink.h"

#include <gtest/gtest.h>

#include "tests/protocol/any_message.h"
#include "tests/protocol/recording_sink.h"

namespace towbench::protocol {
namespace {

TEST(TeeSink, ShowsTheWitnessEveryMessageFirst) {
  RecordingSink witness;
  class Answering final : public MessageSink {
   public:
    using MessageSink::on;
    explicit Answering(RecordingSink& log) : log_(log) {}
    void on(const Advance& /*m*/) noexcept override { log_.texts.emplace_back("answer"); }

   private:
    RecordingSink& log_;
  } target(witness);
  TeeSink tee(witness, target);
  tee.on(Advance{1});
  EXPECT_EQ(witness.texts, (std::vector<std::string>{"Advance 1", "answer"}));
}

TEST(TeeSink, PassesEveryKindOn) {
  RecordingSink witness;
  RecordingSink target;
  TeeSink tee(witness, target);
  for (unsigned kind = 0; kind < AnyMessage::kKinds; ++kind) {
    AnyMessage(kind).send_to(tee, kind);
  }
  EXPECT_EQ(target.texts.size(), AnyMessage::kKinds);
  EXPECT_EQ(witness.texts, target.texts);
}

}  // namespace
}  // namespace towbench::protocol
