// The part of LightLabPanel that follows the document: pictures, captions, what is read out.
#include "app/editor/document/DocumentController.h"
#include "app/editor/job/LatestJob.h"
#include "app/editor/panel/LabTexts.h"
#include "app/editor/panel/LightLabPanel.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/viewport/IblUpdater.h"
#include "app/editor/viewport/PixelProbe.h"
#include "app/editor/widget/ElidedLabel.h"
#include "core/document/ViewChoices.h"
#include "core/light/DfgLookup.h"
#include "core/light/LatLongGrid.h"
#include "core/math/Shading.h"
#include "core/mix/LightMix.h"

#include <QLabel>

namespace patina::editor {

// --- What is shown -------------------------------------------------------------------------------

void LightLabPanel::follow(const Change& change) {
    const auto concerns = [&](Scope scope) {
        return !change.target || change.target->scope == scope;
    };
    if (concerns(Scope::Environment) || concerns(Scope::Softbox))
        refreshLight();
    if (concerns(Scope::Model))
        refreshDfg();
    if (concerns(Scope::View))
        invalidate();
}

void LightLabPanel::setLuminance(const Luminance& luminance) {
    m_luminance = luminance;
    if (needsLuminance(m_controller.document().view))
        invalidate();
}

void LightLabPanel::refreshLight() {
    if (!m_seen)
        return; // when it is seen
    const EnvironmentPart environment = shownEnvironment(m_controller.document());
    m_light.lookup.orientation = environment.orientation;
    m_light.lookup.setScale(environment.scale);
    if (environment.image != m_image) {
        m_image = environment.image;
        if (!m_image) {
            m_analysisJob->cancel();
            m_light.lookup.analysis = nullptr;
            m_light.reductions = nullptr;
        } else {
            m_analysisJob->request(
                [this, image = m_image](const JobContext& job) -> LatestJob::Apply {
                    const EnvironmentAnalysisPtr analysis = analyseEnvironment(image, job);
                    const LabReductionsPtr reductions =
                        analysis ? reduceForPictures(*analysis, job) : nullptr;
                    if (!reductions)
                        return {};
                    return [this, analysis, reductions] {
                        if (!m_image)
                            return;
                        m_light.lookup.analysis = analysis;
                        m_light.reductions = reductions;
                        invalidate();
                    };
                });
        }
    }
    invalidate();
}

void LightLabPanel::refreshMaps() {
    if (!m_seen)
        return;
    const std::shared_ptr<const IblMaps> maps = m_ibl.maps();
    if (!maps) {
        m_ibl.requestMaps();
        return;
    }
    if (m_light.lookup.maps == maps)
        return;
    m_light.lookup.maps = maps;
    m_irradianceError = irradianceError(*maps);
    invalidate();
}

void LightLabPanel::refreshDfg() {
    if (!m_seen)
        return;
    const ShadingModel& model = m_controller.document().model;
    const std::pair terms(model.distribution, iblVisibility(model.visibility));
    if (m_dfgTerms == terms)
        return;
    m_dfgTerms = terms;
    m_dfgJob->request([this, terms](const JobContext&) -> LatestJob::Apply {
        auto dfg = std::make_shared<const LabDfg>(computeLabDfg(terms.first, terms.second));
        return [this, dfg] {
            m_dfg = dfg;
            for (LabPicture* widget : {picture({LabKind::Dfg, 0}), picture({LabKind::Dfg, 1}),
                                       picture({LabKind::Dfg, 2}), m_stage}) {
                if (!widget->view().isTable())
                    continue;
                const auto channel = static_cast<std::size_t>(widget->view().index);
                widget->setPicture(dfg->pictures[channel]);
                widget->setColorRange(dfg->range[channel]);
            }
            refreshCaptions();
            refreshPicked();
        };
    });
}

void LightLabPanel::invalidate() {
    ++m_state;
    if (!m_seen)
        return;
    refreshCaptions();
    m_request.start();
}

// One request holds all pictures that are seen and not up to date; when it is answered, the next
// follows, if there is any.
void LightLabPanel::requestPictures() {
    if (!m_seen || m_pictureJob->busy())
        return;
    struct Wanted {
        std::size_t cell; // m_cells.size(): the stage
        LabView view;
        QSize size;
    };
    std::vector<Wanted> wanted;
    const auto consider = [&](std::size_t index, const Cell& cell) {
        const LabView view = cell.widget->view();
        if (view.isTable() || !cell.widget->isVisible() || cell.widget->visibleRegion().isEmpty())
            return;
        const QSize size = cell.widget->pictureSize();
        if (cell.state != m_state || cell.size != size)
            wanted.push_back({index, view, size});
    };
    consider(m_cells.size(), m_large);
    for (std::size_t i = 0; i < m_cells.size(); ++i)
        consider(i, m_cells[i]);
    if (wanted.empty())
        return;
    m_pictureJob->request([this, wanted, state = m_state, light = m_light,
                           view = m_controller.document().view, luminance = m_luminance,
                           offset = m_offsetEv](const JobContext& job) -> LatestJob::Apply {
        const LabTone tone(view, luminance, offset);
        std::vector<QImage> pictures;
        for (const Wanted& each : wanted)
            pictures.push_back(labPicture(light, each.view, each.size, tone, job));
        return [this, wanted, state, pictures] {
            for (std::size_t i = 0; i < wanted.size(); ++i) {
                const Wanted& each = wanted[i];
                Cell& cell = each.cell < m_cells.size() ? m_cells[each.cell] : m_large;
                if (cell.widget->view() != each.view)
                    continue; // the stage shows another one meanwhile
                cell.widget->setPicture(pictures[i]);
                cell.state = state;
                cell.size = each.size;
            }
            m_request.start();
        };
    });
}

// --- Texts ---------------------------------------------------------------------------------------

QString LightLabPanel::message(LabView view) const {
    if (view.isTable())
        return {};
    if (!m_controller.document().environment().image)
        return tr("There is no environment.");
    return {};
}

void LightLabPanel::refreshCaptions() {
    const auto apply = [&](LabPicture* widget, bool whole) {
        const LabView view = widget->view();
        LabCaption c = labCaption(view, whole, m_light, m_irradianceError);
        if (const auto& picked = widget->picked(); view.isTable() && !whole && picked && m_dfg)
            c.detail = labNumber(static_cast<double>(
                lookUpDfg(m_dfg->table, picked->NoV, picked->perceptualRoughness)[view.index]));
        widget->setCaption(c.title, c.detail, c.warning);
        widget->setReason(message(view));
        std::optional<glm::vec3> lowest;
        if (view.kind == LabKind::Harmonics && !c.warning.isEmpty())
            lowest = m_light.lookup.bandSumError(view.index).lowestDirection;
        widget->setLowest(lowest);
        if (!whole) {
            const LabCaption full = labCaption(view, true, m_light, m_irradianceError);
            QStringList lines{full.title, full.detail, full.warning};
            lines.removeAll(QString());
            widget->setToolTip(lines.join(QLatin1Char('\n')));
        }
    };
    for (const Cell& cell : m_cells)
        apply(cell.widget, false);
    apply(m_stage, true);

    QStringList notes;
    if (!m_controller.document().environment().problem.empty())
        notes << tr("A neutral grey stands in for the environment.");
    if (m_controller.document().view.toneMap == ToneMap::OpenColorIo)
        notes << tr("Shown through PBR Neutral: OpenColorIO runs in the viewport only.");
    m_note->setText(notes.join(QLatin1Char(' ')));
    m_note->setToolTip(m_note->text());
    m_note->setVisible(!notes.isEmpty());
}

void LightLabPanel::refreshPicked() {
    if (!m_seen)
        return;
    const std::optional<render::Inspection>& pixel = m_probe.shown();
    const bool known = pixel && pixel->onSurface();
    const auto mark = [&](LabPicture* widget) {
        if (!known) {
            widget->setPicked(std::nullopt, {});
            return;
        }
        const LabView view = widget->view();
        LabPlace place;
        if (view.isTable()) {
            place.NoV = pixel->value(shading::kViewNoV).x;
            place.perceptualRoughness = pixel->value(shading::kViewPerceptualRoughness).x;
            QString label = tr("(%1, %2)")
                                .arg(labFixed(static_cast<double>(place.NoV), 3),
                                     labFixed(static_cast<double>(place.perceptualRoughness), 3));
            if (m_dfg)
                label += tr(" = %1").arg(labNumber(static_cast<double>(
                    lookUpDfg(m_dfg->table, place.NoV, place.perceptualRoughness)[view.index])));
            widget->setPicked(place, label);
            return;
        }
        // Where its light comes from: irradiance by the normal, reflections by the lobe.
        const glm::vec3 direction(pixel->value(
            view.isIrradiance() ? shading::kViewShadingNormal : shading::kRecordLobeDirection));
        const float length = glm::length(direction);
        if (!(length > 0.0f) || view.kind == LabKind::Harmonics) {
            widget->setPicked(std::nullopt, {});
            return;
        }
        place.direction = direction / length;
        QString label;
        if (const auto value = m_light.value(view, place.direction))
            label = labColor(*value);
        if (view.kind == LabKind::Prefiltered)
            label =
                tr("picked: roughness %1")
                    .arg(labFixed(
                        static_cast<double>(pixel->value(shading::kViewPerceptualRoughness).x), 2));
        widget->setPicked(place, label);
    };
    for (const Cell& cell : m_cells)
        mark(cell.widget);
    mark(m_stage);
    refreshCaptions();
}

std::optional<glm::vec3> LightLabPanel::valueAt(LabView view, const LabPlace& place) const {
    if (!view.isTable())
        return m_light.value(view, place.direction);
    return m_dfg ? std::optional(lookUpDfg(m_dfg->table, place.NoV, place.perceptualRoughness))
                 : std::nullopt;
}

void LightLabPanel::point(LabPicture* from, const std::optional<LabPlace>& place) {
    const bool table = from && from->view().isTable();
    for (const Cell& cell : m_cells)
        cell.widget->setPointer(cell.widget->view().isTable() == table ? place : std::nullopt);
    m_stage->setPointer(m_stage->view().isTable() == table ? place : std::nullopt);
    QPalette colors = m_swatch->palette();
    colors.setColor(QPalette::Window, QColor(tokens::kWell));
    if (!place) {
        m_where->setText(tr("Point at a picture to read its light,"));
        m_what->setText(tr("click one to enlarge it."));
        m_swatch->setPalette(colors);
        return;
    }
    const LabView view = from->view();
    if (table) {
        m_where->setText(tr("N·V %1, perceptual roughness %2")
                             .arg(labFixed(static_cast<double>(place->NoV), 3),
                                  labFixed(static_cast<double>(place->perceptualRoughness), 3)));
        if (m_dfg) {
            const glm::vec3 v = lookUpDfg(m_dfg->table, place->NoV, place->perceptualRoughness);
            m_what->setText(tr("A %1, B %2, mean direction %3")
                                .arg(labFixed(static_cast<double>(v.x), 4),
                                     labFixed(static_cast<double>(v.y), 4),
                                     labFixed(static_cast<double>(v.z), 4)));
        }
        m_swatch->setPalette(colors);
        return;
    }
    const glm::dvec2 angles = anglesFromDirection(glm::dvec3(place->direction));
    m_where->setText(tr("azimuth %1°, elevation %2°  (%3  %4  %5)")
                         .arg(labFixed(angles.x, 1), labFixed(angles.y, 1),
                              labFixed(static_cast<double>(place->direction.x), 2),
                              labFixed(static_cast<double>(place->direction.y), 2),
                              labFixed(static_cast<double>(place->direction.z), 2)));
    const std::optional<glm::vec3> value = m_light.value(view, place->direction);
    if (!value) {
        m_what->setText(tr("not computed yet"));
        m_swatch->setPalette(colors);
        return;
    }
    m_what->setText(
        (view.isIrradiance() ? tr("E  %1,  luminance %2") : tr("L  %1,  luminance %2"))
            .arg(labColor(*value), labNumber(static_cast<double>(shading::luminance(*value)))));
    colors.setColor(QPalette::Window, from->colorAt(*place));
    m_swatch->setPalette(colors);
}

} // namespace patina::editor
