// Random interleavings of saving, editing, undo, opening and results that arrive by themselves,
// held against what must be true after each of them. PATINA_SEQUENCES sets how many (each of its
// own seed), PATINA_SEED where they begin; a failure says with which it can be repeated.

#include "app/editor/Session.h"
#include "core/bake/file/BakeIO.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/edit/EditSession.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/scene/DocumentIO.h"
#include "core/scene/ProjectJson.h"

#include <QElapsedTimer>
#include <QFile>
#include <QImage>
#include <QTemporaryDir>
#include <QTest>
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>
#include <map>
#include <random>

namespace patina::editor {
namespace {

constexpr int kSteps = 24; // of a sequence
constexpr int kImages = 6;

unsigned number(const char* variable, unsigned otherwise) {
    const char* text = std::getenv(variable);
    return text != nullptr ? static_cast<unsigned>(std::strtoul(text, nullptr, 10)) : otherwise;
}

// What of a document is compared: all but navigation and bakes, which are compared apart.
std::string textOf(Document document, const std::string& file) {
    document.bakes.clear();
    document.view.camera = Camera();
    return documentToJson(document, file);
}

class SaveModel : public ::testing::Test {
  protected:
    void SetUp() override {
        QImage image(2, 2, QImage::Format_RGB32);
        for (int i = 0; i < kImages; ++i) {
            image.fill(QColor(40 * i, 10, 10));
            ASSERT_TRUE(image.save(file(QStringLiteral("%1.png").arg(i))));
        }
        controller.setReplaceQuestion([this](const std::function<void()>& proceed) {
            ++counts["asked before replacing"];
            if (chance(2))
                proceed();
        });
        controller.setSaveQuestion([this](const SaveQuestion& question) {
            ++counts["asked before overwriting"];
            ++asked;
            if (chance(2))
                question.overwrite();
            else
                question.done(false);
        });
        QObject::connect(&controller, &DocumentController::sceneOpened, [this] { begin(); });
        QObject::connect(&controller, &DocumentController::saved, [this](const QString& to) {
            if (const auto others = changedByOthers.find(to); others != changedByOthers.end()) {
                EXPECT_GT(asked, others->second) << "what others wrote is gone, unasked";
                ++counts["overwritten after asking"];
                changedByOthers.erase(others);
            }
        });
        open(QStringLiteral("builtin:plane"));
        ASSERT_FALSE(document().materials.empty());
        controller.saveAs(file(QStringLiteral("base.patina")));
        settle();
    }

    [[nodiscard]] QString file(const QString& name) const { return folder.filePath(name); }
    const Document& document() const { return controller.document(); }
    UndoStack& undo() { return controller.undoStack(); }
    bool chance(unsigned of) { return random() % of == 0; }
    template <class Elements>
    Id any(const Elements& elements) {
        return elements[random() % elements.size()].id;
    }
    void settle() {
        ASSERT_TRUE(QTest::qWaitFor([&] { return !controller.tasks().busy(); }, 60'000));
        QCoreApplication::processEvents();
    }
    void open(const QString& scene) {
        controller.openScene(scene);
        settle();
    }
    // A document of its own begins.
    void begin() {
        contents.clear();
        ids.clear();
        meant.clear();
        drag = 0;
        changedByOthers.clear();
    }
    [[nodiscard]] int redoable() { return undo().count() - undo().index(); }
    BakeArtifactPtr randomBake(BakeKind kind) {
        BakeArtifact artifact;
        artifact.kind = kind;
        artifact.samplesDone = static_cast<int>(random() % 100000);
        artifact.order = holdsTransfer(kind) ? 1 : 0;
        const float value = static_cast<float>(random() % 1024) / 1024.0f;
        for (const MeshInstance& mesh : document().meshes)
            artifact.vertices.push_back(
                {mesh.id, 1, std::vector<float>(mesh.mesh->vertexCount(), value)});
        return std::make_shared<const BakeArtifact>(std::move(artifact));
    }

    std::string step();
    void check();
    void checkFile();

    std::mt19937 random;
    QTemporaryDir folder;
    Session session;
    DocumentController& controller = session.controller;

    std::map<std::pair<quint64, quint64>, std::string> contents; // of states that were seen
    std::map<Id, std::string> ids;                               // that were ever used: by whom
    std::map<std::string, Id> meant;        // for which material each image was read last
    std::map<QString, int> changedByOthers; // with how often was asked before
    DragSession drag = 0;
    int asked = 0, compared = 0;
    std::map<std::string, int> counts;
};

std::string SaveModel::step() {
    const ParameterInfo& rough = parameter("material.perceptualRoughness");
    const auto value = static_cast<float>(random() % 1000) / 1000.0f;
    const Target material{Scope::Material, any(document().materials)};
    const BakeKind kind = chance(2) ? BakeKind::AoVertex : BakeKind::PrtVertex;
    const int redoBefore = redoable();
    const auto arrived = [&](const char* what) {
        if (redoBefore > 0) {
            EXPECT_EQ(redoable(), redoBefore) << what << " erased what could be redone";
        }
        return std::string(what);
    };
    switch (random() % 20) {
    case 0:
    case 1:
        controller.setParameter(rough, material, value);
        return "edit";
    case 2:
        drag = controller.newDragSession();
        [[fallthrough]];
    case 3:
    case 4:
        controller.setParameter(rough, {Scope::Material, document().materials.front().id}, value,
                                drag);
        return "drag";
    case 5: {
        // Back to where the last step began: a drag that returns leaves none.
        const float before = document().materials.front().perceptualRoughness;
        const Target first{Scope::Material, document().materials.front().id};
        drag = controller.newDragSession();
        controller.setParameter(rough, first, value, drag);
        controller.setParameter(rough, first, before, drag);
        return "drag and back";
    }
    case 6:
    case 7:
        if (undo().canUndo())
            undo().undo();
        return "undo";
    case 8:
        if (undo().canRedo())
            undo().redo();
        return "redo";
    case 9:
    case 10:
        controller.saveAs(controller.saveTarget());
        return "save";
    case 11: {
        const QString to =
            file(chance(2) ? QStringLiteral("a.patina") : QStringLiteral("b.patina"));
        // The file dialog has asked: the scene has, or will have by then, another file.
        if (to != controller.filePath() || controller.tasks().busy())
            changedByOthers.erase(to);
        controller.saveAs(to);
        return "save as";
    }
    case 12:
        controller.attachBake(randomBake(kind));
        return arrived("bake finished");
    case 13:
        if (const BakeArtifactPtr bake = findBake(document(), kind)) {
            auto after = std::make_shared<BakeArtifact>(*bake);
            after->albedo = Hash{random() % 3, 1};
            for (VertexBake& vertices : after->vertices)
                vertices.values.assign(vertices.values.size(),
                                       static_cast<float>(after->albedo.high) / 4.0f);
            controller.renewBake(bake, after);
        }
        return arrived("bake followed");
    case 14:
        controller.removeBake(kind);
        return "remove bake";
    case 15:
        controller.showLighting(chance(2) ? LightingMode::Prt : LightingMode::Ibl);
        return arrived("lighting of a bake");
    case 16: {
        const bool light = chance(2);
        const Id id = light ? controller.addLight(LightType::Point)
                            : controller.duplicateMaterial(material.id);
        EXPECT_FALSE(ids.contains(id)) << "identifier " << id << " was given to " << ids[id];
        ids[id] = light ? "a light" : "a material";
        return "add";
    }
    case 17:
        if (!document().lights.empty())
            controller.removeLight(any(document().lights));
        return "remove";
    case 18: {
        const QString image = file(QStringLiteral("%1.png").arg(random() % kImages));
        // One image, one material: then it is seen where it arrives.
        if (meant.emplace(image.toStdString(), material.id).second &&
            document().material(material.id)->baseColorMap.source.empty())
            controller.setMap(parameter("material.baseColor.map"), material, image);
        return "read a map";
    }
    default:
        break;
    }
    if (chance(3)) {
        changedByOthers.erase(controller.filePath()); // what others wrote is read now
        controller.openScene(controller.filePath());
        return "open";
    }
    if (chance(2)) {
        settle();
        const QString path = controller.filePath();
        QFile others(path);
        EXPECT_TRUE(others.open(QIODevice::Append));
        others.write(" ");
        changedByOthers[path] = asked;
        return "changed by others";
    }
    settle();
    return "wait";
}

// What holds at any time.
void SaveModel::check() {
    const std::string text = textOf(document(), "/p/x.patina");
    const DocumentState state = controller.state();
    const auto [known, isNew] = contents.emplace(std::pair(state.history, state.step), text);
    EXPECT_EQ(known->second, text) << "one state, two contents";
    for (const Material& material : document().materials)
        ids.emplace(material.id, "a material");
    for (const Light& light : document().lights)
        ids.emplace(light.id, "a light");
    for (const MeshInstance& mesh : document().meshes)
        ids.emplace(mesh.id, "a mesh");
}

// When nothing is on its way: what is called saved is what the file holds.
void SaveModel::checkFile() {
    const QString path = controller.filePath();
    if (changedByOthers.contains(path) || controller.isModified())
        return;
    ++compared;
    QFile text(path);
    ASSERT_TRUE(text.open(QIODevice::ReadOnly));
    const Result<project::ParsedProject> there =
        project::parseProject(text.readAll().toStdString(), path.toStdString());
    ASSERT_TRUE(there.ok()) << there.error().text();
    EXPECT_EQ(textOf(there.value().document, path.toStdString()),
              textOf(document(), path.toStdString()))
        << "called saved, but the file holds something else";
    ASSERT_EQ(there.value().bakes.size(), document().bakes.size());
    for (const project::BakeReference& reference : there.value().bakes) {
        const BakeArtifactPtr bake = findBake(document(), reference.kind);
        ASSERT_NE(bake, nullptr);
        const Result<BakeArtifact> saved = loadBake(session.worker, reference.file, document());
        ASSERT_TRUE(saved.ok()) << saved.error().text();
        EXPECT_EQ(saved.value().vertices, bake->vertices) << "called saved, but not its bake";
        EXPECT_EQ(saved.value().samplesDone, bake->samplesDone);
    }
}

TEST_F(SaveModel, WhateverComesInBetweenNothingIsLost) {
    const unsigned sequences = number("PATINA_SEQUENCES", 30);
    const unsigned first = number("PATINA_SEED", 1);
    QElapsedTimer timer;
    timer.start();
    for (unsigned i = 0; i < sequences; ++i) {
        const unsigned seed = first + i;
        SCOPED_TRACE("replay with PATINA_SEQUENCES=1 PATINA_SEED=" + std::to_string(seed));
        random.seed(seed);
        controller.tasks().cancelAll();
        settle();
        controller.setReplaceQuestion([](const std::function<void()>& proceed) { proceed(); });
        open(file(QStringLiteral("base.patina")));
        begin();
        controller.setReplaceQuestion([this](const std::function<void()>& proceed) {
            ++counts["asked before replacing"];
            if (chance(2))
                proceed();
        });
        controller.saveAs(file(QStringLiteral("a.patina")), {}, {true, true, true});
        settle();
        ASSERT_EQ(controller.filePath(), file(QStringLiteral("a.patina")));
        check();
        std::string history;
        for (int s = 0; s < kSteps && !HasFailure(); ++s) {
            const std::string done = step();
            ++counts[done];
            history += done + ", ";
            if (chance(4))
                QCoreApplication::processEvents();
            check();
            if (!controller.tasks().busy())
                checkFile();
        }
        // A last save, and all is well.
        settle();
        checkFile();
        changedByOthers.clear(); // consent was given
        controller.saveAs(controller.filePath(), {}, {true, true, true});
        settle();
        EXPECT_FALSE(controller.isModified());
        checkFile();
        for (const Material& material : document().materials)
            if (const auto image = meant.find(material.baseColorMap.source); image != meant.end()) {
                const bool copied = material.id > image->second; // a duplicate takes it along
                EXPECT_TRUE(material.id == image->second || copied)
                    << "a map went to another material";
            }
        if (HasFailure()) {
            ADD_FAILURE() << history;
            return;
        }
    }
    std::printf("%u sequences of %d steps from seed %u in %.0f s; the file was compared %d times;",
                sequences, kSteps, first, static_cast<double>(timer.elapsed()) / 1000.0, compared);
    for (const auto& [what, count] : counts)
        std::printf(" %s %d,", what.c_str(), count);
    std::printf("\n");
}

} // namespace
} // namespace patina::editor
