#include "core/document/Views.h"
#include "core/document/Document.h"

#include <gtest/gtest.h>
#include <set>

using namespace patina;

namespace {

TEST(Views, EachHasANameOfItsOwnAndSaysWhatItIs) {
    std::set<std::string_view> ids, labels;
    for (const ViewInfo& info : views()) {
        EXPECT_TRUE(ids.insert(info.id).second) << info.id;
        EXPECT_TRUE(labels.insert(info.label).second) << info.label;
        EXPECT_FALSE(info.help.empty()) << info.id;
        EXPECT_LT(info.rangeMin, info.rangeMax) << info.id;
        EXPECT_TRUE(!info.logarithmic || info.rangeMin > 0.0f) << info.id;
        EXPECT_EQ(findView(info.id), &info);
    }
    EXPECT_EQ(views().size(), std::size_t{shading::kViewCount});
    EXPECT_EQ(findView("nothing"), nullptr);
}

TEST(Views, SaysWhyAViewIsEmpty) {
    Document document;
    EXPECT_FALSE(whyEmpty(shading::kViewDirectDiffuse, document).empty());
    EXPECT_FALSE(whyEmpty(shading::kViewShadow, document).empty());
    EXPECT_FALSE(whyEmpty(shading::kViewEmissive, document).empty());
    EXPECT_FALSE(whyEmpty(shading::kViewNormalMap, document).empty());
    EXPECT_TRUE(whyEmpty(shading::kViewFinal, document).empty());

    Light sun;
    sun.id = document.takeId();
    sun.type = LightType::Directional;
    sun.castsShadow = false;
    document.lights.push_back(sun);
    EXPECT_TRUE(whyEmpty(shading::kViewDirectDiffuse, document).empty());
    EXPECT_FALSE(whyEmpty(shading::kViewShadow, document).empty());
    document.lights[0].castsShadow = true;
    EXPECT_TRUE(whyEmpty(shading::kViewShadow, document).empty());
}

} // namespace
