#include "app/editor/document/DraggedElements.h"

#include "core/document/Document.h"
#include "core/document/Snapshot.h"
#include "core/edit/EditSession.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <QCoreApplication>
#include <QDataStream>
#include <QIODevice>
#include <QMimeData>
#include <algorithm>

namespace patina::editor {
namespace {

bool isInScene(const Document& document, CellElement element, Id id) {
    switch (element) {
    case CellElement::Environment:
        return document.environment(id) != nullptr;
    case CellElement::Material:
        return document.material(id) != nullptr;
    case CellElement::Snapshot:
        return document.snapshot(id) != nullptr;
    }
    return false;
}

} // namespace

void setDraggedElements(QMimeData& data, const EditSession& session,
                        const DraggedElements& elements) {
    QByteArray bytes;
    QDataStream out(&bytes, QIODevice::WriteOnly);
    out << static_cast<qint64>(QCoreApplication::applicationPid())
        << static_cast<quint64>(session.documentNumber()) << static_cast<qint32>(elements.element)
        << static_cast<quint32>(elements.ids.size());
    for (const Id id : elements.ids)
        out << static_cast<qint64>(id);
    data.setData(QLatin1String(kElementsMime), bytes);
}

std::optional<DraggedElements> draggedElements(const QMimeData& data, const EditSession& session) {
    QDataStream in(data.data(QLatin1String(kElementsMime))); // whoever dragged it may be another
    qint64 process = 0;
    quint64 scene = 0;
    qint32 element = 0;
    quint32 count = 0;
    in >> process >> scene >> element >> count;
    if (in.status() != QDataStream::Ok || process != QCoreApplication::applicationPid() ||
        scene != session.documentNumber() || element < 0 ||
        element >= static_cast<qint32>(kCellElements.size()))
        return std::nullopt;
    DraggedElements elements{static_cast<CellElement>(element), {}};
    for (quint32 i = 0; i < count && !in.atEnd(); ++i) {
        qint64 id = 0;
        in >> id;
        if (in.status() == QDataStream::Ok &&
            isInScene(session.document(), elements.element, static_cast<Id>(id)))
            elements.ids.push_back(static_cast<Id>(id));
    }
    return elements.ids.empty() ? std::nullopt : std::optional(elements);
}

} // namespace patina::editor
