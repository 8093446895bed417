#include "core/document/View.h"

#include "core/document/ViewChoices.h"

namespace patina {

View::View()
    : exposureMode(ExposureMode::Fixed)
    , exposureMeter(ExposureMeter::Surfaces)
    , toneMap(ToneMap::PbrNeutral)
    , displayTransfer(DisplayTransfer::Srgb)
    , lighting(LightingMode::Ibl)
    , radiosityDivideBy(RadiosityDivision::Gradient)
    , radiosityMethod(RadiosityMethod::Raycast)
    , radiositySolver(RadiositySolver::Gathering)
    , background(BackgroundMode::Environment) {}

} // namespace patina
