#include "core/scene/SceneLoader.h"

#include "core/base/Check.h"
#include "core/base/InputFile.h"
#include "core/base/Utf8.h"
#include "core/document/SceneSource.h"
#include "core/edit/Edit.h"
#include "core/edit/Parameters.h"
#include "core/io/MeshImport.h"
#include "core/job/Parallel.h"
#include "core/light/GeneratedEnvironment.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/material/MaterialInputs.h"
#include "core/mesh/VisualScenes.h"
#include "core/mix/EnvironmentBlend.h"
#include "core/scene/ModelConversion.h"
#include "core/scene/OutsidePictures.h"

#include <algorithm>
#include <atomic>
#include <fmt/format.h>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace patina {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kShownFiles = 5; // in the notice that sums up the missing ones

std::string fileNameOf(const std::string& file) {
    return makeValidUtf8(fs::path(file).filename().string());
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

// "a, b and 7 more", each by what `shown` makes of it.
template <class Shown>
std::string firstOf(const std::vector<std::string>& files, const Shown& shown) {
    std::vector<std::string> names;
    for (const std::string& file : files)
        if (names.size() < kShownFiles)
            names.push_back(shown(file));
    std::string text = fmt::format("{}", fmt::join(names, ", "));
    if (files.size() > kShownFiles)
        text += fmt::format(" and {} more", files.size() - kShownFiles);
    return text;
}

// Calls visit(info, slot) for each map of the material; the slot may be changed.
template <class Visit>
void forEachMap(Material& material, const Visit& visit) {
    Document scratch;
    scratch.materials.push_back(std::move(material));
    const Id id = scratch.materials.front().id;
    for (const ParameterInfo& info : parameters()) {
        if (info.scope != Scope::Material || info.type != ParameterType::Map)
            continue;
        ParameterValue value = info.get(scratch, id);
        if (visit(info, std::get<MapSlot>(value)))
            info.set(scratch, id, value);
    }
    material = std::move(scratch.materials.front());
}

ImagePtr neutralEnvironment() {
    Image image(64, 32, 3, PixelType::F32, ColorEncoding::Linear);
    std::ranges::fill(image.f32(), 0.5f);
    return std::make_shared<const Image>(std::move(image));
}

// Names for what is appended to a list: "Wheel", "Wheel 2" …, in linear time for huge models.
class Namer {
  public:
    template <class Elements>
    explicit Namer(const Elements& elements) {
        for (const auto& element : elements)
            m_taken.insert(element.name);
    }
    std::string unique(const std::string& name) {
        std::string candidate = name;
        int& number = m_next.try_emplace(name, 2).first->second;
        while (!m_taken.insert(candidate).second)
            candidate = fmt::format("{} {}", name, number++);
        return candidate;
    }

  private:
    std::unordered_set<std::string> m_taken;
    std::unordered_map<std::string, int> m_next;
};

} // namespace

SceneLoader::SceneLoader(WorkerClient* worker, const JobContext& job)
    : m_worker(worker)
    , m_job(job) {}

void SceneLoader::addNotice(std::string message, const fs::path& file) {
    Notice notice{std::move(message), file};
    if (std::find(m_notices.begin(), m_notices.end(), notice) == m_notices.end())
        m_notices.push_back(std::move(notice));
}

void SceneLoader::addMissing(const std::string& file) {
    if (m_known.insert(file).second)
        m_missing.push_back(file);
}

std::vector<Notice> SceneLoader::takeNotices(const fs::path& file) {
    std::vector<Notice> notices = std::exchange(m_notices, {});
    addOutsideNotice(m_outside, "model", file, notices);
    addOutsideNotice(m_outsideProject, "project", file, notices);
    if (m_missing.empty())
        return notices;
    std::string text =
        fmt::format("{} missing: {}", m_missing.size() == 1 ? "a file is" : "files are",
                    firstOf(m_missing, fileNameOf));
    text += ". Put the files back and open it again, or assign others";
    notices.insert(notices.begin(), Notice{std::move(text), file});
    return notices;
}

void SceneLoader::addOutsideNotice(const std::vector<std::string>& files, const char* whose,
                                   const fs::path& file, std::vector<Notice>& notices) const {
    if (files.empty())
        return;
    const bool one = files.size() == 1;
    notices.insert(
        notices.begin(),
        Notice{fmt::format("{} outside the {}'s folder and {} left out: {}",
                           one ? "a picture lies" : "pictures lie", whose, one ? "is" : "are",
                           firstOf(files, [](const std::string& path) { return path; })),
               file});
}

void SceneLoader::stayWithin(const fs::path& project,
                             std::function<bool(const std::string& file)> mayShow) {
    std::error_code ignored;
    m_projectFolder.emplace(fs::absolute(project, ignored).parent_path());
    m_mayShow = std::move(mayShow);
}

bool SceneLoader::liesOutside(const std::string& source) {
    if (!m_projectFolder)
        return false;
    const std::string file = fileOfPicture(source);
    std::error_code unknown;
    // Of a file that is not there nothing can be shown: it is missing, as any other.
    if (file.empty() || m_mayShow(file) || m_projectFolder->isInside(file) ||
        !fs::exists(file, unknown))
        return false;
    if (!contains(m_outsideProject, source))
        m_outsideProject.push_back(source);
    return true;
}

const Result<SceneLoader::Model>& SceneLoader::model(const std::string& source) {
    const auto known = m_models.find(source);
    if (known != m_models.end())
        return known->second;
    return m_models.emplace(source, readModel(source)).first->second;
}

Result<SceneLoader::Model> SceneLoader::readModel(const std::string& source) {
    if (isBuiltin(source)) {
        Result<std::vector<library::ModelPart>> parts = library::model(builtinName(source));
        if (!parts)
            return parts.error();
        return convertModel(*parts);
    }
    CHECK(m_worker != nullptr);
    const SceneSource scene = parseSceneSource(source);
    const fs::path file = scene.file;
    m_job.setActivity("reading " + fileNameOf(scene.file));
    Result<ImportedModel> imported = importModel(*m_worker, file, scene.title);
    if (!imported)
        return imported.error();
    if (imported->scenes.size() > 1) {
        addNotice(fmt::format("of {} visual scenes \"{}\" is shown, not {}",
                              imported->scenes.size(), imported->scenes[imported->scene],
                              listVisualScenes(imported->scenes, imported->scene)),
                  file);
        m_chosen.push_back({scene.file, imported->scenes, imported->scene, !scene.title.empty()});
    }
    for (const std::string& warning : imported->warnings)
        addNotice(warning, file);
    // The importer counts empty files among them: loadMaps() says what is wrong with those.
    for (const std::string& missing : imported->missingTextures) {
        const fs::path path = (file.parent_path() / missing).lexically_normal();
        std::error_code unknown;
        if (!fs::exists(path, unknown))
            addMissing(path.string());
    }
    for (const std::string& outside : imported->outsideTextures)
        if (std::string name = normalizeSource(outside); !contains(m_outside, name))
            m_outside.push_back(std::move(name));
    Model model = convertModel(*std::move(imported), source); // which embedded images name
    Namer names(m_cameras);
    for (SceneCamera camera : model.cameras) {
        camera.name = names.unique(camera.name);
        m_cameras.push_back(std::move(camera));
    }
    return model;
}

void SceneLoader::loadMaps(std::span<Material> materials) {
    // Collect each image once, however many maps share it.
    struct Request {
        std::string source;
        ColorEncoding encoding;
        const std::vector<Bytes>* embedded = nullptr;
        std::optional<Result<MapImage>> result;
    };
    std::vector<Request> requests;
    std::map<std::pair<std::string, ColorEncoding>, std::size_t> indices;
    const auto wanted = [](const MapSlot& slot) { return !slot.source.empty() && !slot.image; };
    for (Material& material : materials)
        forEachMap(material, [&](const ParameterInfo& info, const MapSlot& slot) {
            if (wanted(slot) &&
                indices.try_emplace({slot.source, info.mapEncoding}, requests.size()).second)
                requests.push_back({slot.source, info.mapEncoding, nullptr, std::nullopt});
            return false;
        });
    for (Request& request : requests) {
        if (contains(m_outside, request.source))
            request.result = Error{ErrorKind::InputMissing, kOutsideProblem, request.source, {}};
        else if (liesOutside(request.source))
            request.result =
                Error{ErrorKind::InputMissing, kOutsideProjectProblem, request.source, {}};
    }
    for (Request& request : requests)
        if (const auto embedded = parseEmbeddedSource(request.source);
            embedded && !request.result) {
            const Result<Model>& owner = model(embedded->model);
            if (owner.ok())
                request.embedded = &owner->embeddedImages;
            else
                request.result = owner.error();
        }

    // Small images of one model are read together: starting a process takes longer than they do.
    constexpr std::size_t kMostTogether = 32;
    std::vector<std::vector<std::size_t>> batches; // of requests
    std::map<const std::vector<Bytes>*, std::size_t> open;
    for (std::size_t i = 0; i < requests.size(); ++i) {
        const Request& request = requests[i];
        if (request.result)
            continue;
        const bool small =
            request.embedded != nullptr &&
            mayLoadTogether(embeddedMap(request.source, request.encoding, *request.embedded));
        if (!small) {
            batches.push_back({i});
            continue;
        }
        const auto [batch, isNew] = open.try_emplace(request.embedded, batches.size());
        if (isNew || batches[batch->second].size() == kMostTogether) {
            batch->second = batches.size();
            batches.emplace_back();
        }
        batches[batch->second].push_back(i);
    }

    // As many at a time as there are cores.
    std::atomic<std::size_t> done{requests.size()};
    for (const std::vector<std::size_t>& batch : batches)
        done -= batch.size();
    parallelFor(m_job, batches.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end && !m_job.cancelled(); ++b) {
            Request& first = requests[batches[b].front()];
            m_job.setActivity("reading " + fileNameOf(first.source));
            if (batches[b].size() == 1) {
                first.result = readMapImage(m_worker, first.source, first.encoding, first.embedded);
            } else {
                std::vector<ImageInMemory> images;
                for (const std::size_t i : batches[b])
                    images.push_back(embeddedMap(requests[i].source, requests[i].encoding,
                                                 *requests[i].embedded));
                std::vector<Result<MapImage>> read = readEmbeddedMaps(*m_worker, images);
                for (std::size_t k = 0; k < read.size(); ++k)
                    requests[batches[b][k]].result = std::move(read[k]);
            }
            m_job.setProgress(static_cast<double>(done += batches[b].size()) /
                              static_cast<double>(requests.size()));
        }
    });
    if (m_job.cancelled())
        return;

    // Note what went wrong, in the order of the materials.
    for (const Request& request : requests) {
        const Result<MapImage>& result = *request.result;
        if (contains(m_outside, request.source) || contains(m_outsideProject, request.source))
            continue; // summed up by takeNotices()
        if (!result.ok() && result.error().message == kNoSuchFile) {
            addMissing(request.source);
        } else if (!result.ok()) {
            addNotice(result.error().message, request.source);
        } else if (result->repairedSamples > 0) {
            addNotice(repairedText(result->repairedSamples), request.source);
        }
    }
    for (Material& material : materials)
        forEachMap(material, [&](const ParameterInfo& info, MapSlot& slot) {
            if (!wanted(slot))
                return false;
            const Result<MapImage>& result =
                *requests[indices.at({slot.source, info.mapEncoding})].result;
            slot.image = result.ok() ? result->image : nullptr;
            slot.problem = result.ok() ? std::string() : result.error().message;
            return true;
        });
}

void SceneLoader::loadEnvironments(Document& document) {
    for (Environment& environment : document.environments) {
        if (!environment.fileImage)
            loadEnvironmentFile(environment);
        resolveEnvironment(environment, m_job);
    }
    resolveBlend(document, m_job);
}

void SceneLoader::loadEnvironmentFile(Environment& environment) {
    if (environment.source.empty()) {
        environment.fileImage = neutralEnvironment();
        return;
    }
    if (liesOutside(environment.source)) {
        environment.fileImage = neutralEnvironment();
        environment.problem = kOutsideProjectProblem;
        return;
    }
    m_job.setActivity("reading " + fileNameOf(environment.source));
    Result<ImagePtr> image =
        readEnvironmentImage(m_worker, environment.source, environment.layout, m_notices, m_job);
    if (image.ok()) {
        environment.fileImage = *std::move(image);
        environment.problem.clear();
        return;
    }
    environment.fileImage = neutralEnvironment();
    environment.problem = image.error().message;
    if (image.error().kind == ErrorKind::InputMissing)
        addMissing(environment.source);
    addNotice("the environment cannot be read: " + image.error().message +
                  "; a neutral grey stands in",
              environment.source);
}

bool appendModel(SceneLoader& loader, Document& document, const std::string& source) {
    const Result<SceneLoader::Model>& model = loader.model(source);
    if (!model)
        return false;

    // Materials that no part uses would only be in the way.
    std::vector<bool> used(model->materials.size(), false);
    for (const SceneLoader::Part& part : model->parts)
        if (part.material < used.size())
            used[part.material] = true;
    std::vector<Id> ids(model->materials.size(), 0);
    const std::size_t first = document.materials.size();
    Namer materialNames(document.materials);
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (!used[i])
            continue;
        Material& material = document.materials.emplace_back(model->materials[i]);
        material.id = ids[i] = document.takeId();
        material.name = materialNames.unique(material.name);
    }

    Namer meshNames(document.meshes);
    for (std::size_t i = 0; i < model->parts.size(); ++i) {
        const SceneLoader::Part& part = model->parts[i];
        MeshInstance& mesh = document.meshes.emplace_back();
        mesh.id = document.takeId();
        mesh.name = meshNames.unique(part.name);
        mesh.source = source;
        mesh.sourceIndex = static_cast<int>(i);
        mesh.mesh = part.mesh;
        mesh.placement = part.transform;
        mesh.material = part.material < ids.size() ? ids[part.material] : 0;
    }

    Namer lightNames(document.lights);
    for (const Light& light : model->lights) {
        Light& added = document.lights.emplace_back(light);
        added.id = document.takeId();
        added.name = lightNames.unique(added.name);
    }
    loader.loadMaps(std::span(document.materials).subspan(first));
    return true;
}

} // namespace patina
