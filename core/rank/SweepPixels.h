// What a camera sees of a scene under radiance transfer: for each pixel the coefficients that
// light, as spherical harmonics, is multiplied with. Sloan, Kautz & Snyder 2002, "Precomputed
// Radiance Transfer": another light is a dot product per pixel, and no ray is cast for it.
#pragma once

#include "core/base/Result.h"
#include "core/document/Document.h"
#include "core/job/JobContext.h"
#include "core/math/Camera.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace patina {

// Those pixels whose centre shows a surface that reflects diffusely. Their order is by rows from
// the top; "planar" arrays hold one number for each of them, then the next number for each of them.
struct SweepPixels {
    int width = 0, height = 0;
    int order = 0;                     // bands of the light
    std::vector<std::uint32_t> places; // y · width + x, ascending
    // Planar, coefficient by coefficient: red, green, blue of diffuse albedo times (T_i + B_i) of
    // core/bake/domain/BakeArtifact.h. Its sum over i with the environment's L_i is radiance.
    std::vector<float> transfer;
    // Planar, red, green, blue: radiance of the document's own lights, which stay where they are.
    std::vector<float> still;
    std::size_t covered = 0; // pixels that show any surface, pure metals among them

    [[nodiscard]] std::size_t count() const { return places.size(); }
};

inline constexpr int kUnshadowedOrder = 5;

// One ray through the centre of each pixel; between vertices transfer is interpolated as triangles
// do. Without a bake nothing is hidden: the clamped cosine in closed form, in kUnshadowedOrder
// bands. Diffuse light alone: reflections and emission are not part of transfer. Shadows of local
// lights are those of the bake, as soft as its bands are. Errors: InputBroken where the bake has no
// values of a mesh that is seen, or nothing is seen that reflects diffusely; those of
// BakeScene::build(); Cancelled.
Result<SweepPixels> traceSweepPixels(const Document& document, const BakeArtifact* bake,
                                     const Camera& camera, int width, int height,
                                     const JobContext& job);

// Radiance of the pixels begin … end under order² coefficients of light: out[c · (end - begin) +
// p]. What bands that are missing make darker than black is black, as in every picture of transfer.
void sweepRadiance(const SweepPixels& pixels, std::span<const glm::vec3> light, std::size_t begin,
                   std::size_t end, std::span<float> out);

} // namespace patina
