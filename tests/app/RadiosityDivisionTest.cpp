// patina bake radiosity --subdivide: evenly, after whole solutions and while light is shot, by what
// --divide-by tells.
#include "CommandsFixture.h"

using namespace patina;
using namespace patina::test;
using testing::HasSubstr;

namespace {

using DivisionOptions = std::vector<std::string>;

} // namespace

TEST_F(Commands, RadiosityDividesWhereItIsTold) {
    const auto bake = [&](const DivisionOptions& more) {
        DivisionOptions all{"bake",
                            "radiosity",
                            "builtin:cornell-reference",
                            "-o",
                            m_folder / "lit.ply",
                            "--set",
                            "environment.enabled=false",
                            "--resolution",
                            "32",
                            "--samples",
                            "16",
                            "--json"};
        all.insert(all.end(), more.begin(), more.end());
        return runPatina(all);
    };
    const auto elements = [&](const DivisionOptions& more) {
        const Outcome outcome = bake(more);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.status == 0 ? outcome.json()["counts"]["elements"].get<int>() : 0;
    };
    const int even = elements({"--subdivide", "0.05"});
    EXPECT_GT(even, 40);
    for (const char* rule : {"gradient", "visibility", "l1", "l2", "linf"}) {
        EXPECT_GT(elements({"--subdivide", "adaptive:0.3,0.05", "--divide-by", rule}), even)
            << rule;
        const Outcome dynamic = bake(
            {"--subdivide", "dynamic:0.3,0.05", "--divide-by", rule, "--solver", "progressive"});
        ASSERT_EQ(dynamic.status, 0) << dynamic.err;
        const nlohmann::json json = dynamic.json();
        EXPECT_GT(json["counts"]["elements"].get<int>(), even) << rule;
        EXPECT_EQ(json["settings"]["divideBy"], rule);
        EXPECT_EQ(json["settings"]["dynamic"], true);
        EXPECT_EQ(json["converged"], true);
    }
    // Less that may differ is more elements.
    EXPECT_GT(elements({"--subdivide", "adaptive:0.4,0.05"}),
              elements({"--subdivide", "adaptive:2,0.05"}));

    for (const auto& [more, said] : std::vector<std::pair<DivisionOptions, const char*>>{
             {{"--subdivide", "dynamic:0.1"}, "southwell"},
             {{"--subdivide", "dynamic:0.1", "--solver", "hierarchical"}, "southwell"},
             {{"--subdivide", "dynamic:"}, "--subdivide is an area"},
             {{"--subdivide", "adaptive:0.1,0"}, "--subdivide is an area"},
             {{"--subdivide", "adaptive:0.1,1,1"}, "--subdivide is an area"},
             {{"--subdivide", "0.1,0.1"}, "--subdivide is an area"},
             {{"--subdivide", "0.1", "--divide-by", "visibility"}, "adaptive:X"},
             {{"--divide-by", "visibility"}, "adaptive:X"},
             {{"--subdivide", "adaptive:0.1", "--divide-by", "l3"}, "--divide-by"},
             {{"--subdivide", "dynamic:0.1", "--solver", "progressive", "--shard", "1/2"},
              "--subdivide dynamic"}}) {
        const Outcome refused = bake(more);
        EXPECT_EQ(refused.status, 2) << refused.err;
        EXPECT_THAT(refused.err, HasSubstr(said));
    }
}
