// Reads what a scene is made of: every model file and every image once, images in parallel. What
// cannot be read becomes a placeholder and a notice, never a failure of the whole.
#pragma once

#include "core/document/Document.h"
#include "core/io/ImageIO.h"
#include "core/io/MeshImport.h"
#include "core/io/TexturePaths.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/scene/Scene.h"

#include <functional>
#include <glm/mat4x4.hpp>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace patina {

class SceneLoader {
  public:
    // `worker` may be null when only built-in things are read.
    SceneLoader(WorkerClient* worker, const JobContext& job);

    // From now on pictures and environments outside the folder of this project are left out, but
    // for the files that it may show (core/scene/OutsidePictures.h).
    void stayWithin(const std::filesystem::path& project,
                    std::function<bool(const std::string& file)> mayShow);

    // One mesh of a model where it stands, and the index of its material in Model::materials.
    struct Part {
        std::string name;
        MeshPtr mesh;
        glm::mat4 transform{1.0f};
        std::size_t material = 0;
    };
    struct Model {
        std::vector<Part> parts;
        std::vector<Material> materials; // ids 0; maps named, but without images
        std::vector<Light> lights;       // ids 0
        std::vector<Bytes> embeddedImages;
        std::vector<SceneCamera> cameras;
    };
    // `source`: a path or builtin:NAME. Notices and missing textures are noted at the first call.
    const Result<Model>& model(const std::string& source);

    // Gives every map that has a source but no image its image, or its problem.
    void loadMaps(std::span<Material> materials);
    // The same for the environments. The first one's image is then that of its kind, and a neutral
    // grey stands in for a file that cannot be read; the second one is then left out of the mix.
    void loadEnvironments(Document& document);
    // Environment::fileImage alone.
    void loadEnvironmentFile(Environment& environment);

    void addNotice(std::string message, const std::filesystem::path& file = {});
    void addMissing(const std::string& file); // noted once

    [[nodiscard]] bool cancelled() const { return m_job.cancelled(); }
    [[nodiscard]] const JobContext& job() const { return m_job; }
    [[nodiscard]] WorkerClient* worker() const { return m_worker; }

    // Everything noted; the missing files, if any, summed up in the first one, which is about
    // `file`.
    [[nodiscard]] std::vector<Notice> takeNotices(const std::filesystem::path& file);
    [[nodiscard]] const std::vector<std::string>& missingFiles() const { return m_missing; }
    [[nodiscard]] const std::vector<ChosenScene>& chosenScenes() const { return m_chosen; }
    // Of all models that were read.
    [[nodiscard]] const std::vector<SceneCamera>& cameras() const { return m_cameras; }

  private:
    Result<Model> readModel(const std::string& source);
    bool liesOutside(const std::string& source); // and notes it
    void addOutsideNotice(const std::vector<std::string>& files, const char* whose,
                          const std::filesystem::path& file, std::vector<Notice>& notices) const;

    WorkerClient* m_worker;
    JobContext m_job;
    std::map<std::string, Result<Model>> m_models;
    std::vector<Notice> m_notices;
    std::vector<ChosenScene> m_chosen;
    std::vector<SceneCamera> m_cameras;
    std::vector<std::string> m_missing;
    std::set<std::string> m_known;      // the same, for looking up
    std::vector<std::string> m_outside; // left out: core/scene/OutsidePictures.h
    std::optional<TexturePaths> m_projectFolder;
    std::function<bool(const std::string& file)> m_mayShow;
    std::vector<std::string> m_outsideProject; // sources, left out, too
};

// Appends the model's parts, the materials they use and its lights. False when it cannot be read:
// `loader.model(source)` has the error and the document is untouched.
[[nodiscard]] bool appendModel(SceneLoader& loader, Document& document, const std::string& source);

// Reads one image; embedded images come from `embedded` (the images of their model).
struct MapImage {
    ImagePtr image;
    std::size_t repairedSamples = 0; // NaN, infinite or negative
};
Result<MapImage> readMapImage(WorkerClient* worker, const std::string& source,
                              ColorEncoding integerEncoding, const std::vector<Bytes>* embedded);

// The same for several images of one model.
std::vector<Result<MapImage>> readEmbeddedMaps(WorkerClient& worker,
                                               std::span<const ImageInMemory> images);
// An embedded image; empty where the model has none of this number.
[[nodiscard]] ImageInMemory embeddedMap(const std::string& source, ColorEncoding integerEncoding,
                                        const std::vector<Bytes>& embedded);

[[nodiscard]] std::string repairedText(std::size_t samples); // for notices

Result<ImagePtr> readEnvironmentImage(WorkerClient* worker, const std::string& source,
                                      EnvironmentLayout layout, std::vector<Notice>& notices,
                                      const JobContext& job);

} // namespace patina
