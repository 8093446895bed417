#include "app/editor/trace/RayTreePanel.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/trace/PathView.h"
#include "app/editor/trace/RayTreeProbe.h"
#include "app/editor/trace/RayTreeTexts.h"
#include "app/editor/widget/ControlHelp.h"
#include "app/editor/widget/ElidedLabel.h"
#include "app/editor/widget/TextButton.h"
#include "core/document/Document.h"
#include "core/math/Shading.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QPainter>
#include <QPushButton>
#include <QSpinBox>
#include <QStackedWidget>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>

namespace patina::editor {
namespace {

enum RayColumn {
    kRayColumn,
    kMeetsColumn,
    kTermsColumn,
    kAddsColumn,
    kShareColumn,
    kEndsColumn,
    kRayColumns
};
constexpr int kNodeRole = Qt::UserRole;
constexpr int kRayMark = 12; // pixels, of a ray's colour

QIcon rayMark(const QColor& color) {
    QPixmap picture(kRayMark, kRayMark);
    picture.fill(Qt::transparent);
    QPainter painter(&picture);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(color);
    painter.drawEllipse(1, 1, kRayMark - 2, kRayMark - 2);
    return QIcon(picture);
}

QString sharePercent(double share) {
    return QLocale().toString(100.0 * share, 'f', 1) + QStringLiteral(" %");
}

} // namespace

RayTreePanel::RayTreePanel(RayTreeProbe& probe, PathView& paths, DocumentController& controller,
                           QWidget* parent)
    : QWidget(parent)
    , m_probe(probe)
    , m_paths(paths)
    , m_controller(controller) {
    setObjectName(QStringLiteral("rayTreePanel"));
    makeTree();
    auto* shown = new QWidget;
    auto* layout = new QVBoxLayout(shown);
    layout->setContentsMargins(tokens::kGap, tokens::kGap, tokens::kGap, tokens::kGap);
    layout->setSpacing(tokens::kGap);
    layout->addWidget(makeHeader());
    layout->addWidget(m_tree, 1);
    m_pages = new QStackedWidget;
    m_pages->addWidget(makeEmpty());
    m_pages->addWidget(shown);
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    outer->setSizeConstraint(QLayout::SetNoConstraint);
    outer->addWidget(m_pages);

    connect(&probe, &RayTreeProbe::changed, this, &RayTreePanel::refresh);
    connect(&probe, &RayTreeProbe::selectionChanged, this, &RayTreePanel::select);
    connect(&paths, &PathView::changed, this, &RayTreePanel::refresh);
    refresh();
}

RayTreePanel::~RayTreePanel() {
    m_probe.setWanted(false);
}

QWidget* RayTreePanel::makeEmpty() {
    m_message = new QLabel;
    m_message->setObjectName(QStringLiteral("rayTreeMessage"));
    m_message->setWordWrap(true);
    m_message->setAlignment(Qt::AlignCenter);
    m_message->setMargin(tokens::kMargin);
    m_show = makeTextButton(tr("Show the Whitted picture"),
                            tr("Traces the picture by the classical ray tracer (Shift+F12)"));
    m_show->setObjectName(QStringLiteral("rayTreeShow"));
    connect(m_show, &QPushButton::clicked, this, &RayTreePanel::pictureWanted);
    auto* empty = new QWidget;
    auto* words = new QVBoxLayout(empty);
    words->addStretch(1);
    words->addWidget(m_message);
    words->addWidget(m_show, 0, Qt::AlignHCenter);
    words->addStretch(1);
    return empty;
}

QWidget* RayTreePanel::makeHeader() {
    m_title = new ElidedLabel;
    m_title->setObjectName(QStringLiteral("rayTreeTitle"));
    m_title->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_model = describe(new QComboBox, tr("Reflection of lights"),
                       tr("How surfaces reflect the light of lights: by the material's BRDF, or by "
                          "the equation of Whitted's paper of 1980"));
    m_model->setObjectName(QStringLiteral("rayTreeModel"));
    m_model->addItems({tr("Material's BRDF"), tr("Whitted 1980")});
    m_model->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    connect(m_model, &QComboBox::activated, this, &RayTreePanel::edit);
    m_depth = describe(new QSpinBox, tr("Deepest level"),
                       tr("How often a branch may be reflected or refracted"));
    m_depth->setObjectName(QStringLiteral("rayTreeDepth"));
    m_depth->setRange(0, kMostWhittedDepth);
    connect(m_depth, &QSpinBox::valueChanged, this, &RayTreePanel::edit);
    auto* depthLabel = new QLabel(tr("Depth"));
    depthLabel->setObjectName(QStringLiteral("dim"));
    depthLabel->setToolTip(m_depth->toolTip());
    QPushButton* clear = makeTextButton(tr("Clear"), tr("Takes the rays out of the viewport"));
    clear->setObjectName(QStringLiteral("rayTreeClear"));
    connect(clear, &QPushButton::clicked, &m_probe, &RayTreeProbe::clear);
    auto* header = new QWidget;
    auto* row = new QHBoxLayout(header);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(tokens::kGap);
    row->addWidget(m_title, 1);
    row->addWidget(m_model);
    row->addWidget(depthLabel);
    row->addWidget(m_depth);
    row->addWidget(clear);
    return header;
}

void RayTreePanel::makeTree() {
    m_tree = describe(new QTreeWidget, tr("Rays of the pixel"),
                      tr("The rays of the pixel: what each meets, what it adds, why it ended. The "
                         "selected one is marked in the viewport"));
    m_tree->setObjectName(QStringLiteral("rayTree"));
    m_tree->setColumnCount(kRayColumns);
    m_tree->setHeaderLabels(
        {tr("Ray"), tr("Meets"), tr("Terms"), tr("Adds"), tr("Share"), tr("Ends")});
    m_tree->headerItem()->setToolTip(
        kTermsColumn,
        tr("Of I = Ia ka + Σ S f Ip [kd N·L + ks (R·V)ⁿ] + kr Ir + kt It, as luminances: ambient "
           "light, what arrives from a light and how it is reflected, and which share of a "
           "reflected or refracted ray counts. S is how much of the light comes through"));
    m_tree->headerItem()->setToolTip(
        kAddsColumn, tr("Light that the ray itself adds to its camera ray: red, green, blue"));
    m_tree->headerItem()->setToolTip(
        kShareColumn, tr("Of the pixel's luminance, with all rays that follow from it"));
    m_tree->setUniformRowHeights(true);
    m_tree->setIndentation(14);
    m_tree->setIconSize({kRayMark, kRayMark});
    m_tree->setSelectionMode(QAbstractItemView::SingleSelection);
    m_tree->header()->setStretchLastSection(false); // what does not fit is scrolled to
    connect(m_tree, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* item) {
        if (!m_filling)
            m_probe.select(item != nullptr ? item->data(kRayColumn, kNodeRole).toInt()
                                           : RayNode::kNone);
    });
}

void RayTreePanel::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    m_probe.setWanted(true);
}

void RayTreePanel::hideEvent(QHideEvent* event) {
    QWidget::hideEvent(event);
    m_probe.setWanted(false);
}

void RayTreePanel::edit() {
    if (m_filling)
        return;
    WhittedSettings settings = m_paths.whitted();
    settings.model = m_model->currentIndex() == 1 ? LocalModel::Whitted1980 : LocalModel::Patina;
    settings.maxDepth = m_depth->value();
    m_paths.setWhitted(settings);
}

void RayTreePanel::refresh() {
    const bool whitted = m_paths.isWhitted();
    m_message->setText(
        whitted ? tr("Click a pixel of the picture to see the rays that it is made of: in the "
                     "viewport, and here as a tree.")
                : tr("This dock shows the rays that a pixel of a classically ray traced picture "
                     "is made of: camera, shadow, reflected and refracted rays."));
    m_show->setVisible(!whitted);
    m_pages->setCurrentIndex(m_probe.shown() ? 1 : 0);
    m_filling = true;
    m_model->setCurrentIndex(m_paths.whitted().model == LocalModel::Whitted1980 ? 1 : 0);
    m_depth->setValue(m_paths.whitted().maxDepth);
    m_filling = false;
    if (m_filled != m_probe.shown().get())
        fill();
}

void RayTreePanel::fill() {
    m_filling = true;
    m_filled = m_probe.shown().get();
    m_items.clear();
    m_tree->clear();
    if (m_probe.shown()) {
        const RayTreeProbe::Shown& shown = *m_probe.shown();
        const Document& document = m_controller.document();
        const auto count = static_cast<int>(shown.tree.sampleCount());
        const glm::vec3 radiance = shown.tree.radiance();
        const auto whole = static_cast<double>(shading::luminance(radiance));
        int camera = 0, rays = 0;
        for (std::size_t i = 0; i < shown.tree.nodes().size(); ++i) {
            const RayNode& node = shown.tree.nodes()[i];
            camera += node.kind == RayKind::Camera ? 1 : 0;
            rays += wasCast(node.end) ? 1 : 0;
            auto* item = node.parent == RayNode::kNone ? new QTreeWidgetItem(m_tree)
                                                       : new QTreeWidgetItem(m_items[node.parent]);
            m_items << item;
            item->setData(kRayColumn, kNodeRole, static_cast<int>(i));
            item->setIcon(kRayColumn, rayMark(rayColor(node)));
            item->setText(kRayColumn, rayName(document, node, camera, count));
            item->setText(kMeetsColumn, rayMeets(document, node));
            item->setText(kTermsColumn, rayTerms(node));
            if (wasCast(node.end))
                item->setText(kAddsColumn, lightText(node.contribution));
            if (whole > 0.0 && wasCast(node.end))
                item->setText(
                    kShareColumn,
                    sharePercent(static_cast<double>(shading::luminance(shown.subtotals[i])) /
                                 whole));
            item->setTextAlignment(kShareColumn, Qt::AlignRight | Qt::AlignVCenter);
            item->setText(kEndsColumn, rayEnds(node));
            const QString help = rayHelp(document, node, shown.subtotals[i]);
            for (int column = 0; column < kRayColumns; ++column) {
                item->setToolTip(column, help);
                if (!wasCast(node.end))
                    item->setForeground(column, QColor(tokens::kTextDim));
            }
        }
        m_title->setText(tr("Pixel %1, %2  ·  %3 rays  ·  %4")
                             .arg(shown.pixel.x)
                             .arg(shown.pixel.y)
                             .arg(rays)
                             .arg(lightText(radiance)));
        m_title->setToolTip(tr("The pixel, how many rays it took, and its light: red, green, blue "
                               "(linear)"));
        // Of the camera ray that is drawn: the others are much alike.
        const int drawn = m_probe.cameraRayOf(m_probe.selected());
        m_items[drawn]->setExpanded(true);
        for (int i = drawn + 1; i < m_items.size() && m_items[i]->parent() != nullptr; ++i)
            m_items[i]->setExpanded(true);
        for (int column = 0; column < kRayColumns; ++column)
            m_tree->resizeColumnToContents(column);
        m_tree->scrollToItem(m_items[drawn], QAbstractItemView::PositionAtTop);
    }
    m_filling = false;
    select();
}

void RayTreePanel::select() {
    const int node = m_probe.selected();
    QTreeWidgetItem* item = node >= 0 && node < m_items.size() ? m_items[node] : nullptr;
    if (item == m_tree->currentItem())
        return;
    m_filling = true;
    m_tree->setCurrentItem(item);
    if (item != nullptr)
        m_tree->scrollToItem(item);
    m_filling = false;
}

} // namespace patina::editor
