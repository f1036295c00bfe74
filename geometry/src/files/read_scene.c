/* The one file that includes assimp. It is asked for no post-processing: its vertex welding compares with a
 * tolerance and keeps corners with different normals apart, so mesh_file welds equal positions itself. */
#include "geometry/mem.h"
#include "geometry/src/files/read_mesh.h"
#include <assimp/cimport.h>
#include <assimp/scene.h>
#include <stdlib.h>
#include <string.h>

typedef struct placed { /* matrix [3][4] row-major, from a node to the scene */
    double m[12];
} placed;

static placed place_in(const placed *parent, const struct aiMatrix4x4 *a)
{
    const ai_real child[12] = {a->a1, a->a2, a->a3, a->a4, a->b1, a->b2, a->b3, a->b4, a->c1, a->c2, a->c3, a->c4};
    placed out;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) {
            double sum = j == 3 ? parent->m[4 * i + 3] : 0;
            for (int k = 0; k < 3; k++) sum += parent->m[4 * i + k] * (double)child[4 * k + j];
            out.m[4 * i + j] = sum;
        }
    return out;
}

static bool mirrors(const placed *a)
{
    const double *m = a->m;
    return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) +
               m[2] * (m[4] * m[9] - m[5] * m[8]) <
           0;
}

static void append_mesh(const struct aiMesh *mesh, const placed *at, polygons *p)
{
    int64_t base = p->point_count, polygon_count = p->polygon_count, corners = p->first[polygon_count];
    p->xyz = GROW_ARRAY(double, p->xyz, 3 * ((size_t)base + mesh->mNumVertices));
    for (unsigned v = 0; v < mesh->mNumVertices; v++) {
        const struct aiVector3D *a = mesh->mVertices + v;
        const double x[3] = {(double)a->x, (double)a->y, (double)a->z};
        for (int i = 0; i < 3; i++) {
            const double *row = at->m + 4 * i;
            p->xyz[3 * ((size_t)base + v) + i] = row[0] * x[0] + row[1] * x[1] + row[2] * x[2] + row[3];
        }
    }
    p->point_count += mesh->mNumVertices;
    int64_t more = 0;
    for (unsigned f = 0; f < mesh->mNumFaces; f++)
        if (mesh->mFaces[f].mNumIndices >= 3) more += mesh->mFaces[f].mNumIndices; /* else a point or a line */
    p->first = GROW_ARRAY(int64_t, p->first, (size_t)polygon_count + mesh->mNumFaces + 1);
    p->corner = GROW_ARRAY(int64_t, p->corner, (size_t)(corners + more));
    bool turn = mirrors(at); /* a mirrored node shows its triangles from the other side */
    for (unsigned f = 0; f < mesh->mNumFaces; f++) {
        const struct aiFace *face = mesh->mFaces + f;
        unsigned n = face->mNumIndices;
        if (n < 3) continue;
        for (unsigned k = 0; k < n; k++) p->corner[corners++] = base + face->mIndices[turn ? n - 1 - k : k];
        p->first[++polygon_count] = corners;
    }
    p->polygon_count = polygon_count;
}

typedef struct wanted {
    const uint8_t *keep; /* by the nodes with a mesh, in the order of the tree; NULL: all */
    int count, seen;
} wanted;

static void append_node(const struct aiScene *scene, const struct aiNode *node, const placed *parent, wanted *w,
                        polygons *p)
{
    placed at = place_in(parent, &node->mTransformation);
    bool keep = !w->keep || !node->mNumMeshes || (w->seen < w->count && w->keep[w->seen]);
    w->seen += node->mNumMeshes > 0;
    for (unsigned i = 0; keep && i < node->mNumMeshes; i++) append_mesh(scene->mMeshes[node->mMeshes[i]], &at, p);
    for (unsigned i = 0; i < node->mNumChildren; i++) append_node(scene, node->mChildren[i], &at, w, p);
}

bool read_mesh_scene(const char *path, const uint8_t *keep, int keep_count, polygons *out, err *e)
{
    wanted w = {keep, keep_count, 0};
    const struct aiScene *scene = aiImportFile(path, 0);
    if (!scene || !scene->mRootNode) {
        if (scene) aiReleaseImport(scene);
        return err_at(e, ERR_INPUT, path, 0, NULL, "cannot be read as a mesh: %s", aiGetErrorString());
    }
    polygons p = polygons_new();
    append_node(scene, scene->mRootNode, &(placed){{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}}, &w, &p);
    aiReleaseImport(scene);
    if (keep && w.seen != keep_count) {
        polygons_free(&p);
        return err_at(e, ERR_INPUT, path, 0, NULL, "names %d nodes with a mesh, but %d of them hold triangles",
                      keep_count, w.seen);
    }
    *out = p;
    return true;
}
