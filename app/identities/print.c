/* The same for people. */
#include "app/identities/identities.h"
#include <math.h>

static void print_gaps(const head_gap gap[HEAD_GAP_COUNT], const char *what, FILE *to)
{
    fprintf(to, "%-16s %8s %8s %8s   %s\n", "mm", "mean", "95 %", "largest", what);
    for (int b = 0; b < HEAD_GAP_COUNT; b++) {
        if (isnan(gap[b].mean_mm))
            fprintf(to, "%-16s %8s %8s %8s\n", head_gap_name(b), "-", "-", "-");
        else
            fprintf(to, "%-16s %8.3f %8.3f %8.3f\n", head_gap_name(b), gap[b].mean_mm, gap[b].p95_mm, gap[b].max_mm);
    }
}

void identities_print(const identities_learnt *l, FILE *to)
{
    const head_model *m = &l->model;
    fprintf(to, "%d heads, %d modes, numbering %.12s\n", m->modes.sample_count, m->modes.mode_count, m->numbering);
    if (l->bytes)
        fprintf(to, "%d heads fitted in %.1f s, %d refused, learnt in %.1f s, %.1f MiB\n", l->fresh, l->fit_s,
                l->refused, l->learn_s, (double)l->bytes / 1048576);
    fprintf(to, "%-6s %8s %9s %9s %21s\n", "mode", "sd mm", "share", "together", "left out, rms mm");
    double together = 0;
    for (int32_t k = 0; k < m->modes.mode_count; k++) {
        together += principal_share(&m->modes, k);
        fprintf(to, "%-6d %8.3f %8.2f%% %8.2f%% ", k + 1, m->modes.sd[k] / sqrt(HEAD_BLOCK_COUNT - 1),
                100 * principal_share(&m->modes, k), 100 * together);
        if (k < m->left_out_modes)
            fprintf(to, "%20.3f\n", m->left_out_rms_mm[k + 1]);
        else
            fprintf(to, "%20s\n", "-");
    }
    print_gaps(m->left_out, "each head made from all others", to);
}

void identity_print(const identities_projection *p, FILE *to)
{
    const principal *modes = &p->model->modes;
    fprintf(to, "%s, fitted in %.1f s\np =", p->name, p->fit_s);
    for (int32_t k = 0; k < modes->mode_count; k++) fprintf(to, "%s%.3f", k ? "," : " ", p->p[k]);
    fprintf(to, "\n");
    print_gaps(p->gap, "from the fitted head to what the model makes of it", to);
    if (p->guessed > 0)
        fprintf(to, "%.1f %% of its skin is not in the scan: guessed, and not counted\n", 100 * p->guessed);
    double most = 0;
    for (int32_t k = 0; k < modes->mode_count; k++) most = fmax(most, fabs(p->p[k]));
    if (most > identities_sd_most)
        fprintf(to, "a coefficient is %.1f standard deviations: the model knows no such head\n", most);
}

void identity_made_print(const identities_made *m, FILE *to)
{
    if (m->random) fprintf(to, "seed %llu, draw %d\n", (unsigned long long)m->seed, m->tries);
    fprintf(to, "p =");
    for (int32_t k = 0; k < m->p_count; k++) fprintf(to, "%s%.3f", k ? "," : " ", m->p[k]);
    fprintf(to,
            "\nleast volume ratio of a tetrahedron %.3f, bone outside the skin %.2f mm, teeth in each other %.2f mm\n",
            m->sound.min_j, m->sound.bone_out_mm, m->sound.teeth_overlap_mm);
    if (m->tissue_anew)
        fprintf(to, "its tissue is the elastic one between its parts: the modes turn some inside out\n");
    fprintf(to, "made %s\n", m->folder);
}
