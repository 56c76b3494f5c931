#include <cmath>
#include <random>

#include <tbb/parallel_for.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include "geometry/phantoms/phantom.h"

namespace vesselbench {

namespace {

/// Newton steps that bring a vertex from linear interpolation onto the surface (error squared each
/// step).
constexpr int kNewtonSteps = 4;
/// Grid points per axis that are skipped together where the surface is far.
constexpr int kBlock = 8;

vtkNew<vtkImageData> sampled(const PhantomField& field, const Eigen::AlignedBox3d& box,
                             double edge) {
    vtkNew<vtkImageData> grid;
    const Eigen::Array3i cells = (box.sizes() / edge).array().ceil().cast<int>();
    grid->SetDimensions(cells[0] + 1, cells[1] + 1, cells[2] + 1);
    grid->SetSpacing(edge, edge, edge);
    grid->SetOrigin(box.min().x(), box.min().y(), box.min().z());
    vtkNew<vtkDoubleArray> values;
    values->SetNumberOfValues(grid->GetNumberOfPoints());
    const Eigen::Array3i points = cells + 1;
    const Eigen::Array3i blocks = (points + kBlock - 1) / kBlock;
    tbb::parallel_for(0, blocks.prod(), [&](int block) {
        const Eigen::Array3i at(block % blocks[0], block / blocks[0] % blocks[1],
                                block / (blocks[0] * blocks[1]));
        const Eigen::Array3i from = at * kBlock, to = (from + kBlock).min(points);
        const double at_centre =
            field(box.min() + edge * 0.5 * (from + to - 1).cast<double>().matrix());
        // The field changes by about 1 mm per mm: a block far from the surface holds only its
        // centre's sign.
        const bool far = std::abs(at_centre) > 1.5 * edge * kBlock;
        for (int k = from[2]; k < to[2]; ++k)
            for (int j = from[1]; j < to[1]; ++j)
                for (int i = from[0]; i < to[0]; ++i)
                    values->SetValue((vtkIdType(k) * points[1] + j) * points[0] + i,
                                     far ? at_centre : field(box.min() + edge * Vec3(i, j, k)));
    });
    grid->GetPointData()->SetScalars(values);
    return grid;
}

Vec3 on_surface(const PhantomField& field, Vec3 p) {
    for (int step = 0; step < kNewtonSteps; ++step) {
        const Vec3 gradient = field.gradient(p);
        const double steepness = gradient.squaredNorm();
        if (steepness < 1e-6) break;
        p -= field(p) / steepness * gradient;
    }
    return p;
}

}  // namespace

Surface exact_surface(const PhantomField& field, const Eigen::AlignedBox3d& box, double edge) {
    const auto grid = sampled(field, box, edge);
    vtkNew<vtkFlyingEdges3D> contour;
    contour->SetInputData(grid);
    contour->SetValue(0, 0.0);
    contour->ComputeNormalsOff();
    contour->ComputeScalarsOff();
    contour->Update();
    vtkPolyData* found = contour->GetOutput();
    Positions points(static_cast<std::size_t>(found->GetNumberOfPoints()));
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t v) {
        Vec3 p;
        found->GetPoints()->GetData()->GetTuple(static_cast<vtkIdType>(v), p.data());
        points[v] = on_surface(field, p);
    });
    std::vector<Triangle> triangles;
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    vtkCellArray* polys = found->GetPolys();
    for (polys->InitTraversal(); polys->GetNextCell(count, ids);) {
        // The field grows outward, VTK's triangles look towards smaller values: swap two corners.
        const Triangle t = {VertexId(ids[0]), VertexId(ids[2]), VertexId(ids[1])};
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
    }
    return make_surface(std::move(points), std::move(triangles));
}

}  // namespace vesselbench
