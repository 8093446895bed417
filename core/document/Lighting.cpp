#include "core/document/Lighting.h"

#include "core/document/ViewChoices.h"

namespace patina {

bool readsBake(LightingMode mode) {
    return mode == LightingMode::Shadowed || mode == LightingMode::Prt;
}

bool hidesNothing(LightingMode mode) {
    return mode == LightingMode::Cosine || mode == LightingMode::ShIrradiance ||
           mode == LightingMode::Unshadowed;
}

LightingMode lightingOf(ViewKind kind, LightingMode ofDocument) {
    return viewInfo(kind).lighting.value_or(ofDocument);
}

} // namespace patina
