#include "core/bake/domain/BakePresets.h"

#include "core/bake/domain/BakeOptions.h"

#include <algorithm>
#include <array>

namespace patina {
namespace {

constexpr std::array kPresets{
    BakePreset{"draft", "Draft", "A first look: few rays, coarse textures, some noise", 64, 512, 64,
               256, 32, 8, 256},
    BakePreset{"good", "Good", "For work: smooth on most scenes", 256, 1024, 1024, 512, 256, 16,
               512},
    BakePreset{"final", "Final",
               "For delivery: four to eight times the rays, textures of twice the side", 2048, 2048,
               4096, 1024, 256, 32, 1024},
};

} // namespace

std::span<const BakePreset> bakePresets() {
    return kPresets;
}

const BakePreset* findBakePreset(std::string_view name) {
    const auto found = std::ranges::find_if(
        kPresets, [&](const BakePreset& preset) { return preset.name == name; });
    return found == kPresets.end() ? nullptr : &*found;
}

BakeRequest withPreset(BakeRequest request, const BakePreset& preset) {
    request.ao.samples = preset.occlusionSamples;
    request.ao.size = preset.occlusionSize;
    request.prt.samples = preset.transferSamples;
    request.prt.size = preset.transferSize;
    request.prt.bounceSamples = preset.bounceSamples;
    request.lightMap.samples = preset.lightMapSamples;
    request.lightMap.size = preset.lightMapSize;
    return request;
}

const BakePreset* presetOf(const BakeRequest& request) {
    const auto found = std::ranges::find_if(kPresets, [&](const BakePreset& preset) {
        return settingsText(withPreset(request, preset)) == settingsText(request);
    });
    return found == kPresets.end() ? nullptr : &*found;
}

} // namespace patina
