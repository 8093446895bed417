#include "core/light/GeneratedEnvironment.h"

#include "core/light/BrightSources.h"
#include "core/light/ClearSky.h"
#include "core/light/EnvironmentResample.h"
#include "core/light/Softboxes.h"

#include <memory>

namespace patina {

EnvironmentRecipe environmentRecipe(const Environment& environment) {
    EnvironmentRecipe recipe;
    recipe.kind = environment.kind;
    if (environment.kind == EnvironmentKind::Sky)
        recipe.sky = environment.sky;
    if (environment.kind == EnvironmentKind::Softboxes) {
        recipe.softboxAmbient = environment.softboxAmbient;
        for (const Softbox& softbox : environment.softboxes) {
            if (!softbox.enabled)
                continue;
            Softbox& kept = recipe.softboxes.emplace_back(softbox);
            kept.id = 0;
            kept.name.clear();
        }
    }
    if (environment.kind == EnvironmentKind::Image && environment.removedSources > 0 &&
        environment.fileImage) {
        recipe.file = environment.fileImage;
        recipe.removedSources = environment.removedSources;
    }
    return recipe;
}

bool isGenerated(const EnvironmentRecipe& recipe) {
    return recipe.kind != EnvironmentKind::Image || recipe.removedSources > 0;
}

ImagePtr generateEnvironment(const EnvironmentRecipe& recipe, int height, const JobContext& job) {
    Image image;
    if (recipe.kind == EnvironmentKind::Sky)
        image = clearSkyImage(recipe.sky, height, job);
    else if (recipe.kind == EnvironmentKind::Softboxes)
        image = softboxImage(recipe.softboxes, recipe.softboxAmbient, height, job);
    else if (recipe.removedSources > 0 && height < kEnvironmentHeight) // a draft
        image = extractBrightSources(shrinkLatLong(*recipe.file, 2 * height), recipe.removedSources,
                                     job)
                    .picture;
    else if (recipe.removedSources > 0)
        image = extractBrightSources(*recipe.file, recipe.removedSources, job).picture;
    if (image.empty() || job.cancelled())
        return nullptr;
    return std::make_shared<const Image>(std::move(image));
}

void resolveEnvironment(Environment& environment, const JobContext& job) {
    const EnvironmentRecipe recipe = environmentRecipe(environment);
    const ImagePtr image = isGenerated(recipe)
                               ? generateEnvironment(recipe, kEnvironmentHeight, job)
                               : environment.fileImage;
    if (image)
        environment.image = image;
}

} // namespace patina
