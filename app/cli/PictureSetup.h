// What the commands that draw pictures share: their options turned into a view of the document, its
// light, and files of what was drawn.
#pragma once

#include "app/cli/Session.h"
#include "core/document/Document.h"
#include "core/edit/ViewJson.h"
#include "core/io/DisplayTransform.h"
#include "core/io/ImageIO.h"
#include "core/light/EnvironmentTexels.h"
#include "render/ViewRenderer.h"
#include "render/gl/Context.h"
#include "render/view/FrameSettings.h"

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace patina::cli {

struct SceneRequest;

// Size and samples. Usage error for what is no size.
Result<render::FrameSettings> frameSettings(const PictureOptions& options);
// Whether files of images are likely to be read, or written in another format than PNG.
[[nodiscard]] bool needsImageLibraries(const PictureOptions& options);

// The camera frames the scene as the editor does, unless a project has one of its own or the
// options name one. Usage error where there is none of the name.
Result<Camera> chooseCamera(Session& session, const PictureOptions& options,
                            const Document& document, const SceneRequest& request, float aspect);

// Exposure, field of view, tone curve, lighting mode and background.
Result<void> applyView(Session& session, const PictureOptions& options, Document& document,
                       render::FrameSettings& frame);

// What the picture is lit by bounces as often as view.bounces says, and off the colours that
// surfaces have now. Errors: Cancelled.
Result<void> followBounces(Session& session, const render::ViewSettings& shown, Document& document);

// Whether such a picture's light comes by way of a transfer bake.
[[nodiscard]] bool isLitByBake(const render::ViewSettings& shown, const Document& document);

// Pictures of a scene that has changed since are no pictures of the scene.
void warnOfStaleBakes(Session& session, const Document& document);

// The view of OpenColorIO that the document asks for; null when it asks for none.
Result<DisplayTransformPtr> openDisplay(Session& session, const View& view);

// Light and background of an environment's picture, for the GPU. Errors: Cancelled.
Result<EnvironmentTexelsPtr> prepareTexels(const ImagePtr& image, const JobContext& job);

// Usage error when pictures of such frames cannot be drawn in it.
Result<std::unique_ptr<gl::Context>> createContext(Session& session,
                                                   const render::FrameSettings& frame);

// The parts of one file, which the report names.
Result<void> writePictures(Session& session, const std::filesystem::path& output,
                           std::vector<ImagePart> pictures, ImageFileFormat format);

// A frame without more to come. Through a lens the mean of as many as that takes, without MSAA.
Result<void> drawFine(render::ViewRenderer& renderer, render::FrameSettings& frame,
                      const JobContext& job);

} // namespace patina::cli
