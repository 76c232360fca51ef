// The engine: the C++ core as WebAssembly. Everything that is physics comes from here.
import bytes from 'virtual:engine-bytes';
import { Decoder } from 'lzma1-decoder';
import { InputBuffer, OutputBuffer } from 'lzma1-streams';
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

const bytesOf = (base64: string): Uint8Array<ArrayBuffer> => Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));

export async function inflate(base64: string): Promise<Uint8Array> {
  const stream = new Blob([bytesOf(base64)]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

export async function loadEngine(): Promise<Module> {
  const wasm = new OutputBuffer(1 << 20);
  new Decoder().decompress(new InputBuffer(bytesOf(bytes)), wasm);
  return create({ wasmBinary: wasm.toArray() });
}
