#include "app/editor/sweep/SweepModel.h"

#include "app/editor/document/QtText.h"

#include <QLocale>
#include <QStringList>
#include <utility>

namespace patina::editor {
namespace {

QString percentText(double share, int decimals) {
    return SweepModel::tr("%1 %").arg(QLocale().toString(100.0 * share, 'f', decimals));
}

QString sameText(const SweepOutcome& outcome, const SameEnvironment& same) {
    const QString name = toQString(outcome.environments[same.of].title);
    return same.rotationDeg != 0.0f
               ? SweepModel::tr("same as %1 rotated by %2")
                     .arg(name, rotationText(static_cast<double>(same.rotationDeg)))
               : SweepModel::tr("same as %1").arg(name);
}

} // namespace

QString rotationText(double degrees) {
    return QStringLiteral("%1°").arg(QLocale().toString(degrees, 'g', 4));
}

QString scoreText(double score, RankBy by) {
    return by == RankBy::Difference ? QLocale().toString(score, 'f', 3) : percentText(score, 2);
}

QString flagText(const SweepOutcome& outcome, const LightScore& score) {
    QStringList flags;
    const std::size_t environment = score.light.environment;
    const SweepEnvironment& measured = outcome.measured[environment];
    if (clips(score))
        flags << SweepModel::tr("clips");
    if (measured.black)
        flags << SweepModel::tr("black");
    if (measured.blackFromOneSide())
        flags << SweepModel::tr("black from one side");
    if (const std::optional<SameEnvironment>& same = outcome.same[environment])
        flags << sameText(outcome, *same);
    return flags.join(QStringLiteral(", "));
}

void SweepModel::setOutcome(SweepOutcomePtr outcome, RankBy by) {
    beginResetModel();
    m_outcome = std::move(outcome);
    m_by = by;
    m_order.clear();
    if (m_outcome)
        m_order = rankLights(m_outcome->sweep, by);
    m_rows.assign(m_order.size(), 0);
    for (std::size_t row = 0; row < m_order.size(); ++row)
        m_rows[m_order[row]] = static_cast<int>(row);
    endResetModel();
}

int SweepModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(m_order.size());
}

int SweepModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(Count);
}

QString SweepModel::text(const LightScore& score, int row, int column) const {
    switch (column) {
    case Rank:
        return QLocale().toString(row + 1);
    case Name:
        return toQString(m_outcome->environments[score.light.environment].title);
    case Rotation:
        return rotationText(score.light.rotationDeg);
    case Score:
        return scoreText(rankingScore(score, m_by), m_by);
    case White:
        return percentText(score.clipped.highlights, 2);
    case Black:
        return percentText(score.clipped.shadows, 2);
    case Contrast:
        return percentText(score.lostContrast, 0);
    case Difference:
        return scoreText(score.difference.worst, RankBy::Difference);
    default:
        return flagText(*m_outcome, score);
    }
}

QVariant SweepModel::sortValue(const LightScore& score, int row, int column) const {
    switch (column) {
    case Rank:
        return row;
    case Rotation:
        return score.light.rotationDeg;
    case Score:
        return rankingScore(score, m_by);
    case White:
        return score.clipped.highlights;
    case Black:
        return score.clipped.shadows;
    case Contrast:
        return score.lostContrast;
    case Difference:
        return score.difference.worst;
    default:
        return text(score, row, column);
    }
}

QVariant SweepModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid() || !m_outcome)
        return {};
    const LightScore& score = m_outcome->sweep.scores[lightOf(index.row())];
    switch (role) {
    case Qt::DisplayRole:
        return text(score, index.row(), index.column());
    case SortRole:
        return sortValue(score, index.row(), index.column());
    case Qt::TextAlignmentRole:
        return QVariant(index.column() == Name || index.column() == Flags
                            ? Qt::AlignLeft | Qt::AlignVCenter
                            : Qt::AlignRight | Qt::AlignVCenter);
    case Qt::ToolTipRole:
        if (index.column() == Name) {
            const SweptEnvironment& environment = m_outcome->environments[score.light.environment];
            return toQString(environment.source.empty() ? environment.title : environment.source);
        }
        if (index.column() == Contrast)
            return tr("%1 stops of contrast, the look compared with has %2")
                .arg(QLocale().toString(score.contrastStops, 'f', 2),
                     QLocale().toString(m_outcome->sweep.referenceContrastStops, 'f', 2));
        if (index.column() == Difference)
            return tr("FLIP of the worst thousandth of the pixels; the mean of all is %1")
                .arg(QLocale().toString(score.difference.mean, 'f', 3));
        return text(score, index.row(), index.column());
    default:
        return {};
    }
}

QVariant SweepModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal)
        return {};
    static const QString kTitles[] = {tr("Rank"),          tr("Environment"), tr("Rotation"),
                                      tr("Score"),         tr("White"),       tr("Black"),
                                      tr("Contrast lost"), tr("Difference"),  tr("Flags")};
    static const QString kHelp[] = {
        tr("1 is the light in which the material fails most, by the chosen score"),
        tr("The environment that lights the scene"),
        tr("How far the environment is rotated about the vertical axis"),
        tr("What lights are ranked by"),
        tr("Pixels of which a channel is at the top of the display"),
        tr("Pixels of which all channels are at the bottom of the display"),
        tr("Contrast that is missing, as a share of that of the look compared with"),
        tr("FLIP between the look compared with and this one, at the worst thousandth of the "
           "pixels"),
        tr("Whether highlights clip, one side gets no light, or another environment is the same")};
    if (role == Qt::DisplayRole)
        return kTitles[section];
    if (role == Qt::ToolTipRole)
        return kHelp[section];
    if (role == Qt::TextAlignmentRole)
        return QVariant(Qt::AlignLeft | Qt::AlignVCenter); // the arrow of sorting is at the right
    return {};
}

} // namespace patina::editor
