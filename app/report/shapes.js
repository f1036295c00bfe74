// The shapes of the page: the counterpart of app/packed.c and app/report_scene.c.

/** Bytes of a base64 text. */
export function bytesOf(text) {
    const binary = atob(text);
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
    return bytes;
}

async function inflate(bytes) {
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Reads what packed_add() wrote, block by block. */
function reader(bytes) {
    let at = 0;
    return (count, stride) => {
        const out = new Int32Array(count);
        for (let i = 0; i < count; i++) {
            const folded =
                bytes[at + i] |
                (bytes[at + count + i] << 8) |
                (bytes[at + 2 * count + i] << 16) |
                (bytes[at + 3 * count + i] << 24);
            const step = (folded >>> 1) ^ -(folded & 1);
            out[i] = step + (i < stride ? 0 : out[i - stride]);
        }
        at += 4 * count;
        return out;
    };
}

function scaled(whole, step) {
    const out = new Float32Array(whole.length);
    for (let i = 0; i < whole.length; i++) out[i] = whole[i] * step;
    return out;
}

/**
 * The shapes of scene.shapes with their arrays: xyz [3*vertices] mm, triangles [3*triangles], and where they have them
 * u [3*vertices] mm (displacement) and colours [3*vertices] sRGB.
 */
export async function unpackShapes(text, scene) {
    const next = reader(await inflate(bytesOf(text)));
    return scene.shapes.map(s => {
        const n = 3 * s.vertices;
        const shape = { ...s, xyz: scaled(next(n, 3), scene.step_mm) };
        if (s.moves) shape.u = scaled(next(n, 3), scene.displacement_step_mm);
        if (s.colours) shape.colours = Uint8Array.from(next(n, 3));
        shape.triangles = Uint32Array.from(next(3 * s.triangles, 3));
        return shape;
    });
}
