#include "core/edit/ParameterReference.h"
#include "core/base/AtomicFile.h"
#include "core/edit/Parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace patina;
using testing::HasSubstr;

TEST(ParameterReference, ThePageInDocsIsUpToDate) {
    const Result<std::string> page =
        readTextFile(PATINA_SOURCE_DIR "/docs/parameters.md", std::size_t{1} << 20);
    ASSERT_TRUE(page.ok()) << page.error().text();
    EXPECT_EQ(*page, parametersAsMarkdown())
        << "write it anew: patina parameters --markdown > docs/parameters.md";
}

TEST(ParameterReference, NamesEveryParameter) {
    const std::string markdown = parametersAsMarkdown(), json = parametersAsJson();
    for (const ParameterInfo& info : parameters()) {
        EXPECT_THAT(markdown, HasSubstr("| `" + std::string(info.id) + "`"));
        EXPECT_THAT(markdown, HasSubstr(std::string(info.help)));
        EXPECT_THAT(json, HasSubstr("\"id\": \"" + std::string(info.id) + "\""));
    }
    EXPECT_THAT(json, HasSubstr("\"default\": \"0.8,0.8,0.8\""));
}
