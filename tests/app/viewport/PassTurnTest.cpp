// Whose pass is next where several traced pictures share the processor.
#include "app/editor/trace/PassTurn.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <vector>

namespace patina::editor {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

// Pictures that begin with passes of reduced size and want them for ever.
class Pictures {
  public:
    static constexpr int kCoarse = 8;
    explicit Pictures(std::size_t count)
        : m_turns(count, {true, kCoarse, 0})
        , m_passes(count, 0) {}

    std::size_t pass() {
        const std::size_t next = nextTurn(m_turns).value();
        PassTurn& turn = m_turns[next];
        turn.last = ++m_time;
        turn.coarseness = turn.coarseness > 1 ? turn.coarseness / 2 : 0;
        ++m_passes[next];
        return next;
    }
    std::vector<std::size_t> passes(int count) {
        std::vector<std::size_t> order;
        for (int i = 0; i < count; ++i)
            order.push_back(pass());
        return order;
    }
    void restart(std::size_t picture) { m_turns[picture].coarseness = kCoarse; }
    void setWants(std::size_t picture, bool wants) { m_turns[picture].wants = wants; }
    [[nodiscard]] const std::vector<int>& had() const { return m_passes; }

  private:
    std::vector<PassTurn> m_turns;
    std::vector<int> m_passes;
    std::uint64_t m_time = 0;
};

TEST(PassTurn, EachHasItsFirstPictureBeforeAnyIsFiner) {
    Pictures pictures(4);
    EXPECT_THAT(pictures.passes(4), ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(pictures.passes(4), ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(pictures.passes(8), ElementsAre(0, 1, 2, 3, 0, 1, 2, 3));
}

TEST(PassTurn, SamplesAreAddedInTurn) {
    Pictures pictures(5);
    pictures.passes(5 * 100);
    EXPECT_THAT(pictures.had(), Each(100));
}

TEST(PassTurn, OneThatBeginsAnewGoesFirst) {
    Pictures pictures(6);
    pictures.passes(6 * 10 + 2); // 0 and 1 were the last
    pictures.restart(4);
    EXPECT_EQ(pictures.pass(), 4u);
    // As it becomes finer the others have their passes, too.
    EXPECT_THAT(pictures.passes(6), ElementsAre(2, 4, 3, 4, 5, 4));
    EXPECT_EQ(pictures.pass(), 0u);
}

// As its values are dragged, say.
TEST(PassTurn, OneThatBeginsAnewAllTheTimeHoldsNobodyUp) {
    Pictures pictures(4);
    pictures.passes(4 * 10);
    for (int i = 0; i < 60; ++i) {
        pictures.restart(1);
        pictures.pass();
    }
    EXPECT_EQ(pictures.had()[1], 10 + 30);
    for (const std::size_t other : {0u, 2u, 3u})
        EXPECT_EQ(pictures.had()[other], 10 + 10) << other;
}

TEST(PassTurn, WhoeverIsDoneIsPassedOver) {
    Pictures pictures(3);
    pictures.passes(3 * 10);
    pictures.setWants(1, false);
    EXPECT_THAT(pictures.passes(4), ElementsAre(0, 2, 0, 2));
    pictures.setWants(0, false);
    EXPECT_THAT(pictures.passes(3), ElementsAre(2, 2, 2)) << "alone";
    pictures.setWants(2, false);
    const PassTurn done{false, 0, 7};
    EXPECT_EQ(nextTurn(std::vector{done, done}), std::nullopt);
    EXPECT_EQ(nextTurn({}), std::nullopt);
}

} // namespace
} // namespace patina::editor
