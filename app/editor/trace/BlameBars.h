// The causes of the drawn picture's error as bars with their shares, for the box over the viewport.
#pragma once

#include "core/trace/blame/Blame.h"

#include <QString>
#include <QStringList>
#include <optional>
#include <vector>

class QFontMetrics;
class QPainter;
class QRect;

namespace patina::editor {

struct BlameBars {
    struct Bar {
        QString label;
        double share = 0.0;
        std::optional<double> here, hereNoise; // of the pixels under the pointer; standard error
    };
    QString title;
    std::vector<Bar> bars; // the largest share first
    QString here;          // over the column of `Bar::here`; empty: there is none
    QString note;          // below them; may be empty

    [[nodiscard]] QStringList lines() const; // as they are read out
    [[nodiscard]] int height(const QFontMetrics& metrics) const;
    void paint(QPainter& painter, const QRect& area) const;
};

// `of`: the picture or a material's name. `here`: of the pixels under the pointer, if any.
[[nodiscard]] BlameBars blameBars(const BlameScore& score, const QString& of,
                                  const std::optional<BlameScore>& here);

} // namespace patina::editor
