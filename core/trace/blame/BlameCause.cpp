#include "core/trace/blame/BlameCause.h"

namespace patina {

const std::array<BlameCauseInfo, kBlameCauses>& blameCauses() {
    static constexpr std::array<BlameCauseInfo, kBlameCauses> kCauses{{
        {BlameCause::Occlusion, "occlusion", "Occlusion", BlameRemedy::BakeTransfer},
        {BlameCause::Lights, "lights", "Lights", BlameRemedy::BakeTransfer},
        {BlameCause::Irradiance, "irradiance", "Irradiance", BlameRemedy::BakeTransfer},
        {BlameCause::Filtering, "filtering", "Filtering", BlameRemedy::PathTracing},
        {BlameCause::LobeDirection, "lobeDirection", "Lobe direction", BlameRemedy::PathTracing},
        {BlameCause::SplitSum, "splitSum", "Split sum", BlameRemedy::PathTracing},
        {BlameCause::Transmission, "transmission", "Transmission", BlameRemedy::PathTracing},
        {BlameCause::Bounces, "bounces", "Bounces", BlameRemedy::BakeTransfer},
        {BlameCause::Rest, "rest", "Rest", BlameRemedy::None},
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
