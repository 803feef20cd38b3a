// What minisign does when it makes a key and signs a file with it.
import { createHash, generateKeyPairSync, randomBytes, sign } from 'node:crypto'

/** A fresh key: `publicKey` as minisign.pub has it, and `signed(bytes)`, the text of a .minisig file. */
export function newKey() {
  const { privateKey, publicKey } = generateKeyPairSync('ed25519')
  const id = randomBytes(8)
  const raw = Buffer.from(publicKey.export({ format: 'jwk' }).x, 'base64url')
  const text = (...parts) => Buffer.concat(parts).toString('base64')
  return {
    publicKey: `untrusted comment: minisign public key\n${text(Buffer.from('Ed'), id, raw)}\n`,
    signed: (bytes) => {
      const comment = 'made for a test'
      const signature = sign(null, createHash('blake2b512').update(bytes).digest(), privateKey)
      const whole = sign(null, Buffer.concat([signature, Buffer.from(comment)]), privateKey)
      return `untrusted comment: signature\n${text(Buffer.from('ED'), id, signature)}\ntrusted comment: ${comment}\n${text(whole)}\n`
    },
  }
}
