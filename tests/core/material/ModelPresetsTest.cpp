// Shading models by name, metals by measurement, and how both reach the shading terms.
#include "core/material/ModelPresets.h"
#include "core/document/Document.h"
#include "core/edit/Parameters.h"
#include "core/material/BrdfModel.h"

#include <gtest/gtest.h>
#include <set>

namespace patina {
namespace {

TEST(ModelPresets, TheFirstIsTheDefaultAndNoTwoAreAlike) {
    const auto presets = modelPresets();
    ASSERT_GE(presets.size(), 3u);
    EXPECT_EQ(presets[0].model, ShadingModel{});
    std::set<std::string_view> titles;
    for (std::size_t i = 0; i < presets.size(); ++i) {
        EXPECT_TRUE(titles.insert(presets[i].title).second);
        EXPECT_TRUE(presets[i].help.ends_with('.'));
        for (std::size_t k = 0; k < i; ++k)
            EXPECT_FALSE(sameChoices(presets[i].model, presets[k].model));
    }
}

TEST(ModelPresets, NumbersAreNoChoices) {
    ShadingModel a, b;
    b.f90 = 0.5f;
    b.ior = 2.0f;
    b.conductorN = glm::vec3(2.0f);
    EXPECT_TRUE(sameChoices(a, b));
    b.lobeDirection = LobeDirection::Mirror;
    EXPECT_FALSE(sameChoices(a, b));
    b = a;
    b.multiScatter = false;
    EXPECT_FALSE(sameChoices(a, b));
}

TEST(Conductors, HaveTheColoursOfTheirMetals) {
    for (const Conductor& metal : conductors()) {
        const glm::vec3 f0 = shading::F_Conductor(1.0f, metal.n, metal.k);
        for (int c = 0; c < 3; ++c) {
            EXPECT_GT(f0[c], 0.3f) << metal.title;
            EXPECT_LT(f0[c], 1.0f) << metal.title;
        }
        if (metal.title == "Gold" || metal.title == "Copper") {
            EXPECT_GT(f0.r, f0.g + 0.1f) << metal.title;
            EXPECT_GT(f0.g, f0.b) << metal.title;
        } else { // greys
            EXPECT_LT(f0.r - f0.b, 0.12f) << metal.title;
        }
        // In the range of the parameters, so that a click on a metal is not clamped.
        for (const char* name : {"model.conductorN", "model.conductorK"}) {
            const ParameterInfo* info = findParameter(name);
            ASSERT_NE(info, nullptr);
            const ParameterValue value = info->id.back() == 'N' ? metal.n : metal.k;
            EXPECT_EQ(clampToRange(*info, value), value) << metal.title;
        }
    }
}

TEST(ModelRows, NamesOfFilesAndScriptsMeanTheTermsTheySay) {
    const auto set = [](Document& document, const char* name, const char* text) {
        const ParameterInfo* info = findParameter(name);
        ASSERT_NE(info, nullptr) << name;
        const auto value = parseParameterValue(*info, text);
        ASSERT_TRUE(value.ok()) << value.error().text();
        info->set(document, 0, *value);
    };
    Document document;
    set(document, "model.distribution", "blinnPhong");
    set(document, "model.visibility", "schlickDirect");
    set(document, "model.fresnel", "conductor");
    set(document, "model.diffuse", "orenNayar");
    set(document, "model.multiScatter", "false");
    set(document, "model.lobeDirection", "mirror");
    set(document, "model.f90", "0.5");
    set(document, "model.ior", "1.33");
    set(document, "model.conductorN", "0.1,0.2,0.3");
    set(document, "model.conductorK", "3,2,1");
    const shading::BrdfModel m = brdfModel(document.model);
    EXPECT_EQ(m.distribution, shading::kDistributionBlinnPhong);
    EXPECT_EQ(m.visibility, shading::kVisibilitySchlickDirect);
    EXPECT_EQ(m.fresnel, shading::kFresnelConductor);
    EXPECT_EQ(m.diffuse, shading::kDiffuseOrenNayar);
    EXPECT_EQ(m.multiScatter, 0);
    EXPECT_EQ(m.lobeDirection, shading::kLobeDirectionMirror);
    EXPECT_EQ(m.f90, 0.5f);
    EXPECT_EQ(m.ior, 1.33f);
    EXPECT_EQ(m.conductorN, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(m.conductorK, glm::vec3(3.0f, 2.0f, 1.0f));
    // The ends of the lists, too: a name in the wrong place would shift them.
    set(document, "model.distribution", "beckmann");
    set(document, "model.visibility", "implicit");
    set(document, "model.fresnel", "dielectric");
    set(document, "model.diffuse", "eon");
    EXPECT_EQ(document.model.distribution, Distribution::Beckmann);
    EXPECT_EQ(document.model.visibility, Visibility::Implicit);
    EXPECT_EQ(document.model.fresnel, Fresnel::Dielectric);
    EXPECT_EQ(document.model.diffuse, Diffuse::Eon);
    EXPECT_FALSE(parseParameterValue(*findParameter("model.ior"), "0.9").ok());
    EXPECT_FALSE(parseParameterValue(*findParameter("model.diffuse"), "phong").ok());
}

} // namespace
} // namespace patina
