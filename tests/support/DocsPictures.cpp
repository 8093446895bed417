// Renders the documentation's pictures of the editor from the editor itself:
//   docs-pictures FOLDER             all of them
//   docs-pictures FOLDER bounces     the Cornell box whose wall is painted
//   docs-pictures FOLDER compare     a wall of materials and environments
//   docs-pictures FOLDER sweep       the lights that a sweep found
//   docs-pictures FOLDER bracket     photos that become an HDR picture
// Run by scripts/docs-pictures on a display of its own.

#include "app/editor/Actions.h"
#include "app/editor/FileFlow.h"
#include "app/editor/MainWindow.h"
#include "app/editor/Session.h"
#include "app/editor/bracket/BracketDialog.h"
#include "app/editor/job/BounceUpdater.h"
#include "app/editor/panel/BakeSettingsForm.h"
#include "app/editor/panel/BrdfLensPanel.h"
#include "app/editor/panel/LightLabPanel.h"
#include "app/editor/panel/SoftboxList.h"
#include "app/editor/radiosity/RadiosityPlots.h"
#include "app/editor/style/Style.h"
#include "app/editor/sweep/LightSweepPanel.h"
#include "app/editor/sweep/SweepStrip.h"
#include "app/editor/viewport/EquationBar.h"
#include "app/editor/viewport/IblUpdater.h"
#include "app/editor/viewport/PixelPicker.h"
#include "app/editor/viewport/PixelProbe.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "app/editor/widget/ContributionChart.h"
#include "core/bake/Bake.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/cells/WallAxes.h"
#include "core/document/ViewChoices.h"
#include "core/library/Library.h"
#include "core/material/Material.h"
#include "tests/support/ExifTiff.h"

#include <QApplication>
#include <QComboBox>
#include <QDialog>
#include <QDir>
#include <QDockWidget>
#include <QElapsedTimer>
#include <QLineEdit>
#include <QMenu>
#include <QMouseEvent>
#include <QPainter>
#include <QProgressBar>
#include <QPushButton>
#include <QSettings>
#include <QStandardPaths>
#include <QSurfaceFormat>
#include <QTemporaryDir>
#include <QToolButton>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

namespace {

using namespace patina::editor;

// Lets the program run until `done` or the time is over; returns whether it was done.
bool runUntil(const std::function<bool()>& done, int milliseconds) {
    QElapsedTimer clock;
    clock.start();
    while (clock.elapsed() < milliseconds) {
        if (done())
            return true;
        QApplication::processEvents(QEventLoop::AllEvents, 20);
    }
    return done();
}

void settle(int milliseconds) {
    runUntil([] { return false; }, milliseconds);
}

// Until the window shows what it will show: everything compiled, the picture in full, the views'
// thumbnails drawn.
void settle(Session& session, MainWindow& window) {
    ViewportWidget& viewport = window.viewport();
    settle(2000); // what an edit sets going begins after a moment
    const QSize full = viewport.size() * viewport.devicePixelRatioF();
    runUntil(
        [&] {
            return !session.controller.tasks().busy() && session.ibl.maps() &&
                   !viewport.waitsForPrograms() && !viewport.compilesPrograms() &&
                   viewport.frameSize() == full;
        },
        60'000);
    bool drawn = viewport.sheets().wanted().empty();
    QObject here;
    QObject::connect(&viewport.sheets(), &SheetScheduler::allDrawn, &here, [&] { drawn = true; });
    viewport.sheets().invalidate();
    runUntil([&] { return drawn; }, 60'000);
    settle(500);
}

bool save(QWidget& widget, const QString& file) {
    if (widget.grab().save(file))
        return true;
    std::fprintf(stderr, "%s: cannot be written\n", qPrintable(file));
    return false;
}

void raiseDock(const MainWindow& window, const QString& name) {
    if (auto* dock = window.findChild<QDockWidget*>(name))
        dock->raise();
}

// The sums of harmonics of the sunset, which has something for every band.
bool saveLightLab(Session& session, MainWindow& window, const QString& file) {
    const QString before =
        QString::fromStdString(session.controller.document().environment().source);
    session.controller.setEnvironment(QStringLiteral("builtin:night"));
    window.actions().lightLab->trigger();
    auto* lab = window.findChild<LightLabPanel*>();
    settle(4000);
    Q_EMIT lab->picture({LabKind::Prefiltered, 2})->chosen();
    settle(session, window);
    runUntil([&] { return lab->idle(); }, 60'000);
    const bool ok = save(window, file);
    window.actions().lightLab->trigger();
    session.controller.setEnvironment(before);
    return ok;
}

// A rough white metal that loses light, in the furnace.
bool saveEnergy(Session& session, MainWindow& window, const QString& file) {
    DocumentController& controller = session.controller;
    runUntil([&] { return !controller.tasks().busy(); }, 30'000);
    const int before = controller.undoStack().index();
    const patina::Id metal = controller.addMaterial();
    const std::vector<patina::MeshInstance> meshes = controller.document().meshes;
    for (const patina::MeshInstance& mesh : meshes)
        controller.assignMaterial(mesh.id, metal);
    session.selection.selectMaterial(metal);
    const auto set = [&](const char* id, const patina::ParameterValue& value) {
        const patina::ParameterInfo& info = *patina::findParameter(id);
        controller.setParameter(
            info, {info.scope, info.scope == patina::Scope::Material ? metal : 0}, value);
    };
    set("material.baseColor", glm::vec3(1.0f));
    set("material.metallic", 1.0f);
    set("material.perceptualRoughness", 0.9f);
    set("model.multiScatter", false);
    raiseDock(window, QStringLiteral("material"));
    window.actions().energy->trigger();
    window.actions().furnace->trigger();
    settle(session, window);
    const bool saved = save(window, file);
    window.actions().furnace->trigger();
    window.actions().energy->trigger();
    controller.session().goTo(before);
    return saved;
}

// The BRDF lens beside two other models, with its lobe on the model where a pixel is pinned.
bool saveLens(Session& session, MainWindow& window, const QString& file) {
    window.actions().lens->trigger();
    settle(1000);
    auto* panel = window.findChild<BrdfLensPanel*>();
    auto* compare = panel->findChild<QToolButton*>(QStringLiteral("raised"));
    for (const QString& name : {QStringLiteral("Unreal Engine 4"), QStringLiteral("Blinn-Phong")}) {
        Q_EMIT compare->menu()->aboutToShow();
        for (QAction* action : compare->menu()->actions())
            if (action->text() == name)
                action->trigger();
    }
    for (auto* choice : panel->findChildren<QComboBox*>())
        if (choice->findData(0u) > 0)
            choice->setCurrentIndex(choice->findData(0u)); // the viewer's lobe
    ViewportWidget& viewport = window.viewport();
    const QPointF place(0.47 * viewport.width(), 0.42 * viewport.height());
    for (const QEvent::Type type : {QEvent::MouseButtonPress, QEvent::MouseButtonRelease}) {
        QMouseEvent event(type, place, viewport.mapToGlobal(place), Qt::LeftButton,
                          type == QEvent::MouseButtonPress ? Qt::LeftButton : Qt::NoButton,
                          Qt::AltModifier);
        QApplication::sendEvent(&viewport, &event);
    }
    const bool drawn = runUntil([&] { return session.lobe.lobe() != nullptr; }, 60'000);
    settle(session, window);
    const bool saved = save(window, file);
    session.probe.setPin(std::nullopt);
    window.actions().lens->trigger();
    return drawn && saved;
}

// How light comes to a point in the ball's opening: the dock alone.
bool saveTransfer(Session& session, MainWindow& window, const QString& file) {
    window.actions().transfer->trigger();
    auto* dock = window.findChild<QDockWidget*>(QStringLiteral("transfer"));
    if (!dock)
        return false;
    settle(session, window);
    window.viewport().picker().pinAt(
        QPointF(window.viewport().width() * 0.54, window.viewport().height() * 0.38));
    runUntil([&] { return session.probe.pin().has_value(); }, 30'000);
    settle(10'000); // the study of the point, which gives way to everything
    const bool ok = save(*dock, file);
    session.probe.setPin(std::nullopt);
    window.actions().transfer->trigger();
    return ok;
}

// The built-in skies in all rotations: the dock alone.
bool saveSweep(Session& session, MainWindow& window, const QString& file) {
    window.actions().lightSweep->trigger();
    auto* dock = window.findChild<QDockWidget*>(QStringLiteral("lightSweep"));
    auto* panel = window.findChild<LightSweepPanel*>();
    if (!dock || !panel)
        return false;
    settle(session, window);
    panel->start();
    runUntil([&] { return panel->outcome() && !panel->strip().isDrawing(); }, 120'000);
    settle(1000);
    const bool ok = panel->outcome() && save(*dock, file);
    window.actions().lightSweep->trigger();
    return ok;
}

// A point of the worn edge pinned, its formulas open.
bool savePixel(Session& session, MainWindow& window, const QString& file) {
    window.actions().pixel->trigger();
    settle(session, window);
    window.viewport().picker().pinAt(
        QPointF(window.viewport().width() * 0.47, window.viewport().height() * 0.42));
    runUntil([&] { return session.probe.pin().has_value(); }, 30'000);
    settle(session, window);
    Q_EMIT window.findChild<ContributionChart*>()->chosen(QStringLiteral("diffuseIbl"));
    settle(200);
    const bool ok = save(window, file);
    session.probe.setPin(std::nullopt);
    window.actions().pixel->trigger();
    return ok;
}

// Pictures in a row, with a caption below each.
struct PictureRow {
    static constexpr int kSide = 440, kGap = 8, kCaption = 34;
    std::vector<std::pair<QImage, QString>> pictures;
    // The square in the middle.
    void add(const QImage& picture, const QString& caption) {
        const int side = std::min(picture.width(), picture.height());
        pictures.emplace_back(
            picture.copy((picture.width() - side) / 2, (picture.height() - side) / 2, side, side)
                .scaled(kSide, kSide, Qt::IgnoreAspectRatio, Qt::SmoothTransformation),
            caption);
    }
    QImage drawn() const {
        const int count = static_cast<int>(pictures.size());
        QImage row(count * (kSide + kGap) - kGap, kSide + kCaption, QImage::Format_RGB32);
        row.fill(QColor(30, 30, 32));
        QPainter painter(&row);
        QFont font = QApplication::font();
        font.setPixelSize(17);
        painter.setFont(font);
        painter.setPen(QColor(225, 225, 225));
        int x = 0;
        for (const auto& [picture, caption] : pictures) {
            painter.drawImage(x, 0, picture);
            painter.drawText(QRect(x, kSide, kSide, kCaption), Qt::AlignCenter, caption);
            x += kSide + kGap;
        }
        return row;
    }
};

// The Cornell box before its left wall was painted, in the first frame that shows what the new
// colour does to the others, and with all coefficients solved anew.
bool saveBounces(Session& session, MainWindow& window, const QString& file) {
    DocumentController& controller = session.controller;
    ViewportWidget& viewport = window.viewport();
    controller.openScene(QStringLiteral("builtin:cornell-box"));
    if (!runUntil([&] { return !controller.tasks().busy(); }, 30'000))
        return false;
    const auto set = [&](const char* id, const patina::Target& target,
                         const patina::ParameterValue& value) {
        controller.setParameter(*patina::findParameter(id), target, value);
    };
    set("view.lighting", {patina::Scope::View, 0}, static_cast<int>(patina::LightingMode::Prt));
    set("environment.rotationDeg", {patina::Scope::Environment, 0}, 90.0f); // into the opening
    set("environment.enabled", {patina::Scope::Environment, 0}, true);
    set("view.exposureMode", {patina::Scope::View, 0},
        static_cast<int>(patina::ExposureMode::Fixed));
    set("view.exposureEv", {patina::Scope::View, 0}, 1.0f);
    patina::Camera camera = controller.document().view.camera;
    camera.yawDeg = -6.0f; // the tall block shows the side that faces the wall
    camera.pitchDeg = 6.0f;
    camera = frameBounds(camera, controller.document().bounds(), 1.0f);
    camera.distance *= 0.95f;
    controller.setCamera(camera);
    viewport.setOverlaysVisible(false);
    patina::TileSink sink;
    patina::PrtSettings settings;
    settings.order = 5;
    settings.transfer = patina::TransferKind::Interreflected;
    const patina::Result<patina::BakeArtifact> bake =
        bakePrtVertex(bakeInputs(controller.document()), settings, sink, {});
    if (!bake)
        return false;
    controller.attachBake(std::make_shared<const patina::BakeArtifact>(*bake));
    if (!runUntil([&] { return session.bounces.upToDate(); }, 120'000))
        return false;
    const QSize full = viewport.size() * viewport.devicePixelRatioF();
    const auto steady = [&] { // the light in full, then the refined frame
        settle(4000);
        runUntil([&] { return viewport.frameSize() == full; }, 30'000);
        return viewport.grabFramebuffer();
    };
    PictureRow row;
    row.add(steady(), QStringLiteral("before"));

    int frames = 0;
    QElapsedTimer clock;
    QObject here;
    QObject::connect(&viewport, &ViewportWidget::frameRendered, &here, [&] { ++frames; });
    QObject::connect(&session.bounces, &BounceUpdater::shownChanged, &here, [&] {
        if (!session.bounces.shown() || row.pictures.size() > 1)
            return;
        const double milliseconds = static_cast<double>(clock.nsecsElapsed()) * 1e-6;
        std::printf("the bleeding followed in frame %d, %.0f ms after the edit\n", frames + 1,
                    milliseconds);
        row.add(viewport.grabFramebuffer(),
                QStringLiteral("frame %1 after the edit").arg(frames + 1));
    });
    const auto& materials = controller.document().materials;
    const auto red = std::find_if(materials.begin(), materials.end(),
                                  [](const auto& material) { return material.name == "Red"; });
    if (red == materials.end())
        return false;
    clock.start();
    set("material.baseColor", {patina::Scope::Material, red->id}, glm::vec3(0.05f, 0.12f, 0.6f));
    if (!runUntil([&] { return session.bounces.upToDate(); }, 60'000))
        return false;
    std::printf("all coefficients were solved after %.0f ms\n",
                static_cast<double>(clock.nsecsElapsed()) * 1e-6);
    row.add(steady(), QStringLiteral("all coefficients solved anew"));
    viewport.setOverlaysVisible(true);
    return row.pictures.size() == 3 && row.drawn().save(file);
}

// Materials of the library on the ball of the start scene, in three environments.
bool saveCompare(Session& session, MainWindow& window, const QString& file) {
    DocumentController& controller = session.controller;
    controller.newDocument();
    runUntil([&] { return !controller.tasks().busy(); }, 30'000);
    for (const char* sky : {"builtin:sunset", "builtin:night"}) {
        controller.addEnvironment(QLatin1String(sky), DocumentController::EnvironmentUse::Light);
        runUntil([&] { return !controller.tasks().busy(); }, 30'000);
    }
    controller.lightWith(controller.document().environments.front().id);
    patina::WallPlan plan;
    plan.columns.compared = patina::Compared::Environments;
    plan.rows.compared = patina::Compared::Materials;
    for (const patina::MeshInstance& mesh : controller.document().meshes)
        if (mesh.name == "Ball")
            plan.rows.meshes = {mesh.id};
    for (const patina::Material& material : controller.document().materials)
        if (material.name != "Ball")
            plan.rows.hidden.push_back(material.id);
    controller.editStructure(QStringLiteral("Materials"), [](patina::Document& document) {
        for (const char* name : {"gold", "copper-patina", "leather"})
            (void)patina::materialNamed(document, std::string("builtin:") + name);
    });
    raiseDock(window, QStringLiteral("material"));
    window.actions().home->trigger();
    session.wall.setPlan(plan);
    session.wall.setOn(true);
    session.wall.setCurrent(4);
    runUntil([&] { return window.viewport().isSettled(); }, 120'000);
    settle(session, window);
    const bool ok = save(window, file);
    session.wall.setOn(false);
    return ok;
}

// The studio by a camera with a film's response, two stops apart, from hand.
bool saveBracket(Session& session, MainWindow& window, const QString& file) {
    const auto studio = patina::library::environment("studio");
    const QTemporaryDir folder;
    if (!studio || !folder.isValid())
        return false;
    const patina::Image& light = **studio;
    QStringList photos;
    for (int i = 0; i < 5; ++i) {
        const double ev = 2.0 * i - 4.0;
        patina::Image photo(light.width(), light.height(), 3, patina::PixelType::U8,
                            patina::ColorEncoding::Data);
        std::size_t at = 0;
        for (int y = 0; y < light.height(); ++y)
            for (int x = 0; x < light.width(); ++x)
                for (int c = 0; c < 3; ++c) {
                    const int from = (x + 3 * (i - 2) + light.width()) % light.width();
                    const double power =
                        std::pow(4.0 * light.linear(from, y)[c] * std::exp2(ev), 0.7);
                    const double code = std::min(1.15 * power / (power + 0.6), 1.0);
                    photo.u8()[at++] = static_cast<std::uint8_t>(std::lround(255.0 * code));
                }
        photos << folder.filePath(QStringLiteral("IMG_410%1.tif").arg(i));
        const std::string bytes = patina::test::tiffWithExposure(photo, std::exp2(ev) / 60.0);
        QFile output(photos.back());
        if (!output.open(QIODevice::WriteOnly) ||
            output.write(bytes.data(), static_cast<qsizetype>(bytes.size())) < 0)
            return false;
    }
    BracketDialog dialog(session.controller, session.jobs, photos, &window);
    dialog.show();
    if (!runUntil([&] { return dialog.result() != nullptr; }, 120'000))
        return false;
    dialog.findChild<QLineEdit*>(QStringLiteral("bracketPath"))
        ->setText(QStringLiteral("/home/artist/studio.exr"));
    settle(800);
    return save(dialog, file);
}

// The Cornell box solved, an element of its floor chosen.
bool saveRadiosity(Session& session, MainWindow& window, const QString& file) {
    DocumentController& controller = session.controller;
    controller.openScene(QStringLiteral("builtin:cornell-reference"));
    runUntil([&] { return !controller.tasks().busy(); }, 30'000);
    window.actions().radiosity->trigger();
    patina::Camera camera = controller.document().view.camera;
    const QSize size = window.viewport().size();
    controller.setCamera(
        patina::frameBounds(camera, controller.document().bounds(),
                            static_cast<float>(size.width()) / static_cast<float>(size.height())));
    controller.showLighting(patina::LightingMode::Radiosity);
    settle(session, window);
    runUntil([&] { return session.radiosity.isWanted() && session.radiosity.upToDate(); }, 60'000);
    if (!session.radiosity.live())
        return false;
    const glm::vec3 from = controller.document().view.camera.position();
    const patina::Bounds bounds = controller.document().bounds();
    const glm::vec3 to = bounds.min + glm::vec3(0.3f, 0.0f, 0.6f) * bounds.size();
    session.radiosity.choose(
        patina::elementAlong(*session.radiosity.live(), from, glm::normalize(to - from)));
    window.findChild<QComboBox*>(QStringLiteral("radiosityPlotted"))
        ->setCurrentIndex(patina::editor::RadiosityPlots::kSurface);
    settle(session, window);
    const bool ok = save(window, file);
    window.actions().radiosity->trigger();
    return ok;
}

} // namespace

int main(int argc, char* argv[]) {
    const auto isAlone = [&](const char* name) {
        return argc == 3 && std::strcmp(argv[2], name) == 0;
    };
    const bool bouncesAlone = isAlone("bounces"), compareAlone = isAlone("compare"),
               sweepAlone = isAlone("sweep"), bracketAlone = isAlone("bracket"),
               radiosityAlone = isAlone("radiosity");
    if (argc != 2 && !bouncesAlone && !compareAlone && !sweepAlone && !bracketAlone &&
        !radiosityAlone) {
        std::fprintf(stderr, "usage: docs-pictures FOLDER [bounces | compare | sweep | bracket | "
                             "radiosity]\n");
        return 2;
    }
    QStandardPaths::setTestModeEnabled(true); // the user's settings stay as they are
    QApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
    QSurfaceFormat format;
    format.setVersion(4, 5);
    format.setProfile(QSurfaceFormat::CoreProfile);
    QSurfaceFormat::setDefaultFormat(format);
    QApplication application(argc, argv);
    QApplication::setOrganizationName(QStringLiteral("PatinaDocs"));
    QApplication::setApplicationName(QStringLiteral("PatinaDocs"));
    applyStyle(application);
    const QDir folder(QString::fromLocal8Bit(argv[1]));
    // A bake that is kept from the last time would be shown as done at once.
    QDir(QStandardPaths::writableLocation(QStandardPaths::CacheLocation) + QStringLiteral("/bakes"))
        .removeRecursively();

    Session session;
    MainWindow window(session);
    window.resetLayout();
    window.resize(1600, 1000);
    window.show();
    window.files().openFromCommandLine({}, {});
    if (!runUntil([&] { return !session.controller.document().meshes.empty(); }, 30'000))
        return 1;
    const QString bounces = folder.filePath(QStringLiteral("bounces.png"));
    if (bouncesAlone)
        return saveBounces(session, window, bounces) ? 0 : 1;
    const QString radiosity = folder.filePath(QStringLiteral("radiosity-dock.png"));
    if (radiosityAlone)
        return saveRadiosity(session, window, radiosity) ? 0 : 1;
    const QString bracket = folder.filePath(QStringLiteral("bracket.png"));
    if (bracketAlone)
        return saveBracket(session, window, bracket) ? 0 : 1;
    const QString compare = folder.filePath(QStringLiteral("compare.png"));
    if (compareAlone)
        return saveCompare(session, window, compare) ? 0 : 1;
    const QString sweep = folder.filePath(QStringLiteral("light-sweep.png"));
    if (sweepAlone)
        return saveSweep(session, window, sweep) ? 0 : 1;
    settle(6000); // image-based light at full resolution
    settle(session, window);
    bool ok = save(window, folder.filePath(QStringLiteral("start.png")));
    ok &= saveLens(session, window, folder.filePath(QStringLiteral("lens.png")));

    // The picture beside one of its factors.
    session.views.show(patina::shading::kViewFinal);
    session.views.showOther(patina::shading::kViewD);
    session.views.edit(
        [](patina::render::ViewSettings& settings) { settings.split->angleDeg = 15.0f; });
    settle(session, window);
    ok &= save(window, folder.filePath(QStringLiteral("looking.png")));
    session.views.set({});

    session.controller.setEnvironmentKind(patina::EnvironmentKind::Softboxes);
    window.findChild<SoftboxList*>()->select(
        session.controller.document().environment().softboxes.front().id);
    settle(6000);
    settle(session, window);
    ok &= save(window, folder.filePath(QStringLiteral("softboxes.png")));
    session.controller.setEnvironmentKind(patina::EnvironmentKind::Image);

    ok &= saveLightLab(session, window, folder.filePath(QStringLiteral("light-lab.png")));

    ok &= savePixel(session, window, folder.filePath(QStringLiteral("pixel.png")));

    // The picture as its sum, and one of its terms as its factors.
    auto* equation = window.findChild<EquationBar*>();
    equation->setFolded(false);
    equation->open(patina::shading::kViewSpecularIbl);
    settle(session, window);
    ok &= save(window, folder.filePath(QStringLiteral("equation.png")));
    equation->close(0);
    equation->setFolded(true);

    // Gold by its refractive index: what the Shading dock offers beyond its presets.
    raiseDock(window, QStringLiteral("model"));
    session.controller.setParameter(*patina::findParameter("model.fresnel"),
                                    {patina::Scope::Model, 0},
                                    static_cast<int>(patina::Fresnel::Conductor));
    settle(session, window);
    ok &= save(window, folder.filePath(QStringLiteral("model.png")));
    session.controller.setParameter(*patina::findParameter("model.fresnel"),
                                    {patina::Scope::Model, 0},
                                    static_cast<int>(patina::Fresnel::Schlick));

    ok &= saveEnergy(session, window, folder.filePath(QStringLiteral("energy.png")));

    raiseDock(window, QStringLiteral("bake"));
    auto* jobsDock = window.findChild<QDockWidget*>(QStringLiteral("jobs"));
    auto* form = window.findChild<BakeSettingsForm*>();
    if (!jobsDock || !form)
        return 1;
    jobsDock->show();
    patina::BakeRequest request;
    request.prt.order = 5;
    request.prt.samples = 256;
    request.prt.transfer = patina::TransferKind::Interreflected;
    request.prt.bounceSamples = 32;
    form->setRequest(request);
    auto* start = window.findChild<QPushButton*>(QStringLiteral("bakeStart"));
    if (!start)
        return 1;
    start->click();
    runUntil(
        [&] {
            const auto jobs = session.jobs.jobs();
            return jobs.empty() || jobs.back().state != JobState::Running ||
                   jobs.back().progress.fraction > 0.3;
        },
        60'000);
    settle(300); // both docks tell how far it is
    ok &= save(window, folder.filePath(QStringLiteral("bake.png")));
    runUntil([&] { return session.jobs.runningCount() == 0; }, 300'000);
    jobsDock->hide();
    session.views.show(patina::shading::kViewShLight);
    session.views.showOther(patina::shading::kViewInterreflectedLight);
    settle(session, window);
    ok &= save(window, folder.filePath(QStringLiteral("lighting.png")));
    session.views.set({});
    ok &= saveTransfer(session, window, folder.filePath(QStringLiteral("transfer.png")));
    ok &= saveSweep(session, window, sweep);

    window.actions().saveEnvironment->trigger();
    settle(800);
    if (auto* dialog = window.findChild<QDialog*>(QStringLiteral("environmentSaveDialog"))) {
        dialog->findChild<QLineEdit*>(QStringLiteral("environmentSavePath"))
            ->setText(QStringLiteral("/home/artist/studio.exr"));
        auto* layout = dialog->findChild<QComboBox*>(QStringLiteral("environmentSaveLayout"));
        layout->setCurrentIndex(layout->count() - 1); // six faces
        settle(800);
        ok &= save(*dialog, folder.filePath(QStringLiteral("save-environment.png")));
        dialog->reject();
    }

    window.actions().exportScene->trigger();
    settle(800);
    if (auto* dialog = window.findChild<QDialog*>(QStringLiteral("exportDialog"))) {
        if (auto* path = dialog->findChild<QLineEdit*>(QStringLiteral("exportPath")))
            path->setText(QStringLiteral("/home/artist/shader-ball.glb"));
        ok &= save(*dialog, folder.filePath(QStringLiteral("export.png")));
        dialog->reject();
    } else {
        ok = false;
    }
    session.jobs.cancelAll();
    ok &= saveBracket(session, window, bracket);
    ok &= saveCompare(session, window, compare);
    ok &= saveBounces(session, window, bounces);
    ok &= saveRadiosity(session, window, radiosity);
    session.controller.tasks().cancelAll();
    return ok ? 0 : 1;
}
