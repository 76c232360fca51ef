// The engine: the C++ core as WebAssembly. Everything that is physics comes from here.
import bytes from 'virtual:engine-bytes';
import create, { type Failure, type Module } from 'tumble-engine';

// An error of bad input, one line "field: what is wrong" or "file:line:column: ...".
export class EngineError extends Error {
  get field(): string {
    return /^([\w .[\]]+):/.exec(this.message)?.[1] ?? '';
  }
}

function isFailure(value: unknown): value is Failure {
  return typeof value === 'object' && value !== null && 'error' in value;
}

// What a function of the engine returned, or its error thrown.
export function checked<T>(value: T | Failure): T {
  if (isFailure(value)) throw new EngineError(value.error);
  return value;
}

export async function inflate(base64: string): Promise<Uint8Array> {
  const deflated = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const stream = new Blob([deflated]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

export async function loadEngine(): Promise<Module> {
  return create({ wasmBinary: await inflate(bytes) });
}
