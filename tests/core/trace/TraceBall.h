// A ball in a uniform environment, whose picture is known.
#pragma once

#include "core/trace/path/TraceInputs.h"

namespace patina::test {

ImagePtr uniformSky(float radiance);
MeshPtr ball(int rings); // of radius 1 around the origin, with tangents and uvs
TraceInputs ballUnderSky(const Material& material, float radiance = 1.0f);

} // namespace patina::test
