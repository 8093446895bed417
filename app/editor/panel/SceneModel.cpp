#include "app/editor/panel/SceneModel.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/DraggedElements.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/ColorConversion.h"
#include "app/editor/widget/Thumbnails.h"
#include "core/edit/EditSession.h"
#include "core/material/Material.h"
#include "core/scene/ImageProblem.h"

#include <QMimeData>
#include <QPainter>
#include <QPixmap>
#include <QStringList>
#include <algorithm>

namespace patina::editor {
namespace {

constexpr quintptr kBranch = 0; // internal id of the branches; their children carry branch + 1

template <class List>
int rowOf(const List& list, Id id) {
    const auto found =
        std::find_if(list.begin(), list.end(), [id](const auto& e) { return e.id == id; });
    return found == list.end() ? -1 : static_cast<int>(found - list.begin());
}

QStringList problemsOf(const Document& document, Id material) {
    QStringList lines;
    for (const std::string& line : mapProblems(document, material))
        lines << QString::fromStdString(line);
    return lines;
}

QIcon swatch(const QColor& color, bool metal) {
    constexpr int kSize = 32; // painted at twice the size for high-density screens
    QPixmap pixmap(kSize, kSize);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    painter.setRenderHint(QPainter::Antialiasing);
    QRadialGradient gradient(QPointF(12, 11), 20);
    gradient.setColorAt(0, color.lighter(metal ? 170 : 125));
    gradient.setColorAt(1, color.darker(metal ? 260 : 160));
    painter.setBrush(gradient);
    painter.setPen(Qt::NoPen);
    painter.drawEllipse(QRectF(3, 3, kSize - 6, kSize - 6));
    return QIcon(pixmap);
}

} // namespace

SceneModel::SceneModel(DocumentController& controller, Thumbnails& thumbnails, QObject* parent)
    : QAbstractItemModel(parent)
    , m_controller(controller)
    , m_thumbnails(thumbnails)
    , m_meshIcon(icon(QStringLiteral("mesh")))
    , m_eyeIcon(icon(QStringLiteral("eye")))
    , m_eyeOffIcon(icon(QStringLiteral("eye-off"), tokens::kTextOff))
    , m_warningIcon(icon(QStringLiteral("warning"), tokens::kCopper)) {
    connect(&thumbnails, &Thumbnails::ready, this, [this] {
        if (m_counts[Materials] > 0)
            Q_EMIT dataChanged(index(0, 0, branchIndex(Materials)),
                               index(m_counts[Materials] - 1, 0, branchIndex(Materials)),
                               {Qt::DecorationRole});
    });
    connect(&controller, &DocumentController::changed, this, &SceneModel::documentChanged);
}

void SceneModel::documentChanged(const Change& change) {
    const Document& document = m_controller.document();
    const int counts[2] = {static_cast<int>(document.meshes.size()),
                           static_cast<int>(document.materials.size())};
    if (touches(change.affects, Affects::Structure) &&
        (counts[0] != m_counts[0] || counts[1] != m_counts[1] || !change.target)) {
        beginResetModel();
        std::copy(std::begin(counts), std::end(counts), std::begin(m_counts));
        endResetModel();
        return;
    }
    for (int branch = 0; branch < 2; ++branch) {
        const bool concerned =
            !change.target ||
            change.target->scope == (branch == Meshes ? Scope::Mesh : Scope::Material) ||
            change.target->scope == Scope::Material; // meshes show the material's name
        if (concerned && m_counts[branch] > 0) {
            const QModelIndex above = branchIndex(static_cast<Branch>(branch));
            Q_EMIT dataChanged(index(0, 0, above),
                               index(m_counts[branch] - 1, ColumnCount - 1, above));
        }
    }
}

QModelIndex SceneModel::branchIndex(Branch branch) const {
    return createIndex(branch, 0, kBranch);
}

QModelIndex SceneModel::indexOf(Target target) const {
    const bool mesh = target.scope == Scope::Mesh;
    if (!mesh && target.scope != Scope::Material)
        return {};
    const Document& document = m_controller.document();
    const int row = mesh ? rowOf(document.meshes, target.id) : rowOf(document.materials, target.id);
    return row < 0 ? QModelIndex() : index(row, 0, branchIndex(mesh ? Meshes : Materials));
}

std::optional<Target> SceneModel::targetAt(const QModelIndex& index) const {
    if (!index.isValid() || index.internalId() == kBranch)
        return std::nullopt;
    const auto row = static_cast<std::size_t>(index.row());
    const Document& document = m_controller.document();
    if (index.internalId() == Meshes + 1)
        return row < document.meshes.size()
                   ? std::optional(Target{Scope::Mesh, document.meshes[row].id})
                   : std::nullopt;
    return row < document.materials.size()
               ? std::optional(Target{Scope::Material, document.materials[row].id})
               : std::nullopt;
}

QModelIndex SceneModel::index(int row, int column, const QModelIndex& parent) const {
    if (row < 0 || column < 0 || column >= ColumnCount || row >= rowCount(parent))
        return {};
    if (!parent.isValid())
        return createIndex(row, column, kBranch);
    return createIndex(row, column, static_cast<quintptr>(parent.row() + 1));
}

QModelIndex SceneModel::parent(const QModelIndex& index) const {
    if (!index.isValid() || index.internalId() == kBranch)
        return {};
    return createIndex(static_cast<int>(index.internalId()) - 1, 0, kBranch);
}

int SceneModel::rowCount(const QModelIndex& parent) const {
    if (!parent.isValid())
        return 2;
    if (parent.internalId() != kBranch || parent.column() != 0)
        return 0;
    return m_counts[parent.row()];
}

int SceneModel::columnCount(const QModelIndex&) const {
    return ColumnCount;
}

QVariant SceneModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid())
        return {};
    if (index.internalId() == kBranch) {
        if (index.column() != NameColumn)
            return {};
        if (role == Qt::DisplayRole)
            return index.row() == Meshes ? tr("Meshes") : tr("Materials");
        if (role == Qt::ForegroundRole)
            return QColor(tokens::kTextDim);
        return {};
    }
    const auto row = static_cast<std::size_t>(index.row());
    if (!targetAt(index))
        return {};
    return index.internalId() == Meshes + 1 ? meshData(row, index.column(), role)
                                            : materialData(row, index.column(), role);
}

QVariant SceneModel::meshData(std::size_t row, int column, int role) const {
    const MeshInstance& mesh = m_controller.document().meshes[row];
    const Material* material = m_controller.document().material(mesh.material);
    switch (role) {
    case Qt::DisplayRole:
    case Qt::EditRole:
        if (column == NameColumn)
            return QString::fromStdString(mesh.name);
        if (column == MaterialColumn && material)
            return QString::fromStdString(material->name);
        break;
    case Qt::DecorationRole:
        if (column == NameColumn)
            return m_meshIcon;
        if (column == MarkColumn)
            return mesh.visible ? m_eyeIcon : m_eyeOffIcon;
        break;
    case Qt::ForegroundRole:
        if (!mesh.visible)
            return QColor(tokens::kTextOff);
        if (column == MaterialColumn)
            return QColor(tokens::kTextDim);
        break;
    case Qt::ToolTipRole:
        if (column == MarkColumn)
            return mesh.visible ? tr("Hide the mesh") : tr("Show the mesh");
        if (mesh.mesh)
            return tr("%1: %L2 triangles, material %3")
                .arg(QString::fromStdString(mesh.name))
                .arg(mesh.mesh->triangleCount())
                .arg(material ? QString::fromStdString(material->name) : QString());
        break;
    case Qt::AccessibleTextRole:
        if (column == MarkColumn)
            return mesh.visible ? tr("Visible") : tr("Hidden");
        break;
    default:
        break;
    }
    return {};
}

QVariant SceneModel::materialData(std::size_t row, int column, int role) const {
    const Material& material = m_controller.document().materials[row];
    if (column != NameColumn) {
        const QStringList problems =
            column == MarkColumn ? problemsOf(m_controller.document(), material.id) : QStringList();
        if (problems.isEmpty())
            return {};
        if (role == Qt::DecorationRole)
            return m_warningIcon;
        if (role == Qt::ToolTipRole || role == Qt::AccessibleTextRole)
            return problems.join(QLatin1Char('\n'));
        return {};
    }
    switch (role) {
    case Qt::DisplayRole:
    case Qt::EditRole:
        return QString::fromStdString(material.name);
    case Qt::DecorationRole:
        return swatch(colorOf(material), material.metallic > 0.5f && !material.metallicMap.image);
    case Qt::ToolTipRole:
        return (problemsOf(m_controller.document(), material.id)
                << tr("%1: double-click or F2 to rename")
                       .arg(QString::fromStdString(material.name)))
            .join(QLatin1Char('\n'));
    case Qt::AccessibleDescriptionRole:
        return problemsOf(m_controller.document(), material.id).join(QLatin1Char('\n'));
    default:
        return {};
    }
}

// What the eye takes for the material's colour: its number times the mean of its map.
QColor SceneModel::colorOf(const Material& material) const {
    glm::vec3 color = material.baseColor;
    const QImage mean = m_thumbnails.thumbnail(material.baseColorMap.image, 1);
    if (!mean.isNull())
        color *= toLinear(mean.pixelColor(0, 0));
    return toDisplay(color);
}

bool SceneModel::setData(const QModelIndex& index, const QVariant& value, int role) {
    const auto target = targetAt(index);
    if (!target || role != Qt::EditRole || index.column() != NameColumn)
        return false;
    m_controller.rename(*target, value.toString());
    return true;
}

Qt::ItemFlags SceneModel::flags(const QModelIndex& index) const {
    if (!index.isValid() || index.internalId() == kBranch)
        return Qt::ItemIsEnabled;
    Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemNeverHasChildren;
    if (index.column() == NameColumn)
        flags |= Qt::ItemIsEditable;
    flags |= index.internalId() == Meshes + 1 ? Qt::ItemIsDropEnabled : Qt::ItemIsDragEnabled;
    return flags;
}

QStringList SceneModel::mimeTypes() const {
    return {QLatin1String(kElementsMime)};
}

QMimeData* SceneModel::mimeData(const QModelIndexList& indexes) const {
    for (const QModelIndex& index : indexes)
        if (const auto target = targetAt(index); target && target->scope == Scope::Material) {
            auto* data = new QMimeData;
            setDraggedElements(*data, m_controller.session(),
                               {CellElement::Material, {target->id}});
            return data;
        }
    return nullptr;
}

bool SceneModel::canDropMimeData(const QMimeData* data, Qt::DropAction, int, int,
                                 const QModelIndex& parent) const {
    const auto target = targetAt(parent);
    const auto dragged = draggedElements(*data, m_controller.session());
    return target && target->scope == Scope::Mesh && dragged &&
           dragged->element == CellElement::Material;
}

bool SceneModel::dropMimeData(const QMimeData* data, Qt::DropAction action, int row, int column,
                              const QModelIndex& parent) {
    if (!canDropMimeData(data, action, row, column, parent))
        return false;
    m_controller.assignMaterial(targetAt(parent)->id,
                                draggedElements(*data, m_controller.session())->ids.front());
    return true;
}

} // namespace patina::editor
