/** What went wrong, as one sentence for the reader. */
export class ApiError extends Error {
  override readonly name = 'ApiError'
  constructor(
    message: string,
    /** HTTP status; 0 when the service could not be reached. */
    readonly status: number,
  ) {
    super(message)
  }

  /** Asking again may help. */
  get passing(): boolean {
    return this.status === 0 || this.status >= 500 || this.status === 429
  }
}

const UNREACHABLE = 'The service does not answer. Check that it runs and that you are online, then try again.'

/** The sentence of an RFC 9457 problem document, or one of our own when there is none. */
export function fromResponse(status: number, body: unknown): ApiError {
  if (typeof body === 'object' && body !== null) {
    const { detail, title } = body as { detail?: unknown; title?: unknown }
    if (typeof detail === 'string' && detail) return new ApiError(detail, status)
    if (typeof title === 'string' && title) return new ApiError(title, status)
  }
  if (status === 404) return new ApiError('There is nothing at this address.', status)
  if (status === 413) return new ApiError('The file is too large for this service.', status)
  return new ApiError(`The service answered with an error (status ${status}) and gave no reason.`, status)
}

/** Any thrown thing as an `ApiError`; a failed connection reads as such. */
export function asApiError(thrown: unknown): ApiError {
  if (thrown instanceof ApiError) return thrown
  if (thrown instanceof TypeError) return new ApiError(UNREACHABLE, 0)
  return new ApiError(thrown instanceof Error ? thrown.message : String(thrown), 0)
}
