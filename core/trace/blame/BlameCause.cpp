#include "core/trace/blame/BlameCause.h"

namespace patina {

const std::array<BlameCauseInfo, kBlameCauses>& blameCauses() {
    static constexpr std::array<BlameCauseInfo, kBlameCauses> kCauses{{
        {BlameCause::Occlusion, "occlusion", "Occlusion",
         "Surfaces that hide the environment count by an occlusion map or bake, or not at all",
         BlameRemedy::BakeTransfer},
        {BlameCause::Lights, "lights", "Lights",
         "Shadows of lights come from shadow maps or are left out, lights with extent reflect by a "
         "fitted lobe",
         BlameRemedy::BakeTransfer},
        {BlameCause::Irradiance, "irradiance", "Irradiance",
         "Diffuse light of the environment comes from nine coefficients, for all diffuse models "
         "alike",
         BlameRemedy::BakeTransfer},
        {BlameCause::Filtering, "filtering", "Filtering",
         "Reflections are looked up between texels and roughness levels of the prefiltered "
         "environment",
         BlameRemedy::PathTracing},
        {BlameCause::LobeDirection, "lobeDirection", "Lobe direction",
         "Reflections are filtered with a round lobe about one direction instead of the lobe of "
         "this view",
         BlameRemedy::PathTracing},
        {BlameCause::SplitSum, "splitSum", "Split sum",
         "Reflected light and reflectance are averaged over the lobe each by itself",
         BlameRemedy::PathTracing},
        {BlameCause::Bounces, "bounces", "Bounces",
         "Light that other surfaces reflect or emit is left out", BlameRemedy::BakeTransfer},
        {BlameCause::Rest, "rest", "Rest",
         "Edges, emission and the background, which each renderer samples in its own way",
         BlameRemedy::None},
    }};
    return kCauses;
}

const BlameCauseInfo& infoOf(BlameCause cause) {
    return blameCauses()[static_cast<std::size_t>(cause)];
}

BlameRemedyInfo infoOf(BlameRemedy remedy) {
    switch (remedy) {
    case BlameRemedy::BakeTransfer:
        return {"bakeTransfer", "Bake Transfer: diffuse light with its shadows and bounces"};
    case BlameRemedy::PathTracing:
        return {"pathTracing", "Path tracing alone is without this error"};
    case BlameRemedy::None:
        break;
    }
    return {"none", "Nothing in the scene removes it"};
}

} // namespace patina
